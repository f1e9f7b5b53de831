/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "clouds.h"

#include <io/geometry.h>

#include <Eigen/Geometry>

#include <string>
#include <vector>

namespace benchmarks {

/** \brief A scan, and where it was made. */
struct VirtualScan {
  tool::Geometry geometry;
  std::string thing; ///< what it shows: an object or a place
  std::string name;  ///< its file, or the number of the view
  /** \brief Maps the scan to the frame of the thing; rigid. */
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
};

using VirtualScans = std::vector<VirtualScan>;

/** \brief A scan whose points are those of a cloud. */
VirtualScan
virtualScan(const Cloud& cloud,
            const std::string& thing,
            std::size_t view,
            const Eigen::Isometry3d& pose);

} // namespace benchmarks
