/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "io/geometry.h"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <cstddef>

namespace tool {

/** \brief What the points of merged clouds have beside their places. */
struct PointExtras {
  bool normals = true, colours = true, intensity = true;
};

/** \brief What has to be known of a scan before it is merged with others. */
struct ScanLook {
  std::size_t points = 0; ///< that are finite
  PointExtras extras;
  /** \brief Around most of its points, whatever strays, in the frame of its group. */
  Eigen::AlignedBox3d box;
  /** \brief Some of its points, spread over all, in the frame of its group. */
  Points drawn;
};

/** \brief The points of a scan; of a mesh as many as are to stand for it. */
pcl::PCLPointCloud2
pointsOf(const Geometry& scan, std::size_t samples);

/** \brief Look at a scan.
 * \param[in] cloud its points
 * \param[in] pose of the scan in its group
 * \param[in] drawn so many points at most are to be drawn
 */
ScanLook
lookAt(const pcl::PCLPointCloud2& cloud,
       const Eigen::Matrix4d& pose,
       std::size_t drawn);

} // namespace tool
