/*
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * Where poses place scans, as far as their descriptions tell.
 */

#pragma once

#include <pcl/registration/kss/scan_work.h>

namespace pcl {
namespace kss {

/** \brief The root mean square distance of a scan's points from their mean. */
double
radiusOf(const ScanDescription& scan);

/** \brief How far apart two rigid poses place a scan, root mean square over its points.
 */
double
displacement(const ScanDescription& scan,
             const Eigen::Matrix4d& a,
             const Eigen::Matrix4d& b);

/** \brief The information over the rotation (about the axes that the pose leads to) and
 * the translation of the centroid that a scan has whose points are known to a unit, as
 * a whole: the square of displacement() is its quadratic form.
 */
Eigen::Matrix<double, 6, 6>
informationOfDisplacement(const ScanDescription& scan, const Eigen::Matrix4d& pose);

/** \brief How much of two scans lies on each other at a pose, by their outlines. */
struct ExpectedOverlap {
  double most = 0.0;  ///< the share of the scan of which more is covered
  double least = 0.0; ///< that of the other one
};

/** \brief The overlap that is to be expected at a pose of one scan on another. */
ExpectedOverlap
expectedOverlap(const ScanDescription& source,
                const ScanDescription& target,
                const Eigen::Matrix4d& pose);

/** \brief The inverse of a rigid pose. */
inline Eigen::Matrix4d
inverted(const Eigen::Matrix4d& pose)
{
  return Eigen::Isometry3d(pose).inverse().matrix();
}

} // namespace kss
} // namespace pcl
