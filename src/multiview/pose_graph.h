/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/scan_work.h>

#include <cstddef>
#include <vector>

namespace pcl {
namespace kss {

/** \brief What is known of two poses. */
struct PoseLink {
  std::size_t source = 0, target = 0; ///< scans
  /** \brief Where the source is in the target. */
  StoredPose transformation = StoredPose::Identity();
  /** \brief Over the rotation about the axes of the target, and the translation of the
   * source's centroid; may be singular. */
  Eigen::Matrix<double, 6, 6, Eigen::DontAlign> information =
      Eigen::Matrix<double, 6, 6, Eigen::DontAlign>::Zero();
};

/** \brief The poses at which links are broken least.
 * \param[in] scans descriptions of all scans
 * \param[in] group the scans that are placed; the first one stays where it is
 * \param[in] links between scans of the group; those that are off by many of their
 * standard deviations have no say
 * \param[in,out] poses of all scans, to the frame of the group
 */
void
solvePoses(const std::vector<ScanDescription>& scans,
           const std::vector<std::size_t>& group,
           const std::vector<PoseLink>& links,
           std::vector<StoredPose>& poses);

} // namespace kss
} // namespace pcl
