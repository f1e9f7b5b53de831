/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/export.h>

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace pcl {
namespace kss {

/** \brief Where most points of a cloud lie: what its frame and its extent go by,
 * whatever a few of them are.
 */
struct Bulk {
  /** \brief The median of the points, along each axis. */
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  /** \brief Half of the points are no farther from the middle. */
  double radius = 0.0;

  /** \brief Whether a position lies so near that one grid in single precision can hold
   * it and tell the others apart.
   *
   * Of the 24 bits of a coordinate that is so far out, a grid from there on leaves half
   * to what lies within the radius: enough for a thousandth of it, which no sampling
   * comes near. Scans have their farthest returns at some hundred radii at most.
   */
  bool
  holds(const Eigen::Vector3d& position) const
  {
    constexpr double reach = 1 << 12;
    return (position - middle).squaredNorm() <= reach * radius * reach * radius;
  }
};

/** \brief So many points tell the bulk of a cloud. */
constexpr std::size_t bulk_points = 4096;

/** \brief The bulk of some points, of which copies count once: many of them are
 * returns that never were.
 * \param[in] some points of a cloud, spread over it; at least one, all finite
 */
PCL_KSS_ICP_EXPORT Bulk
bulkOf(std::vector<Eigen::Vector3d> some);

/** \brief Throw where single precision cannot square the distances of a cloud, or sum
 * them up.
 * \throws std::invalid_argument
 */
PCL_KSS_ICP_EXPORT void
throwIfTooWide(const Bulk& bulk);

/** \brief Throw where a cloud in single precision lies so far from the origin that its
 * coordinates are rounded by more than its points lie apart.
 * \throws std::invalid_argument
 */
PCL_KSS_ICP_EXPORT void
throwIfTooFar(const Bulk& bulk);

} // namespace kss
} // namespace pcl
