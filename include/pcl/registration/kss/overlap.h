/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/nearest_points.h>

#include <limits>

#include <Eigen/Geometry>

namespace pcl {
namespace kss {

/** \brief How near a surface a point counts as covered by it, in spacings: of random
 * points on a surface, one in a thousand has no point of another such sampling within
 * this distance. */
constexpr float covered = 1.5f;

/** \brief How much of two clouds lies on each other at a pose. */
struct Overlap {
  /** \brief The share of the source that the target covers, in [0, 1]. */
  double source = 0.0;
  /** \brief The share of the target that the source covers, in [0, 1]. */
  double target = 0.0;
  /** \brief How closely: the sum over both clouds of the mean of max(0, 1 - d^2 / h^2),
   * d being the distance of a point to the other cloud and h the spacing of the points
   * there. In [0, 2]; two samplings of one surface come to 1.5, whatever the shape, the
   * density or the noise, less the missing parts.
   */
  double score = 0.0;
};

/** \brief Measure the overlap at a pose.
 *
 * The tolerance is the spacing of the points, the wider one of the two clouds: a
 * surface covers another sampling of itself that closely, and hardly anything else.
 * \param[in] source points of the source, and their spacing
 * \param[in] target points of the target, and their spacing
 * \param[in] pose a similarity from source to target
 */
Overlap
overlapAt(const NearestPoints& source,
          const NearestPoints& target,
          const Eigen::Matrix4d& pose,
          Eigen::Index most = std::numeric_limits<Eigen::Index>::max());

} // namespace kss
} // namespace pcl
