/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/settings.h>

#include <algorithm>

namespace pcl {
namespace kss {

/** \brief How far a placed source and the target lie apart. */
struct DirectedDistances {
  /** \brief The directed Hausdorff distance from the source: the largest distance of a
   * source point to its nearest target point. */
  float source_to_target;
  /** \brief The mean of those distances, none counted beyond the limit. */
  float mean_source_to_target;
  /** \brief The directed Hausdorff distance from the target. */
  float target_to_source;
  /** \brief The mean distance of the target points to their nearest source points, none
   * counted beyond the limit. */
  float mean_target_to_source;

  /** \brief The Hausdorff distance H of (e9): the larger of the directed ones. */
  float
  hausdorff() const
  {
    return std::max(source_to_target, target_to_source);
  }
};

/** \brief How much the two directed distances count in an energy: (1, 1) for complete
 * clouds and for two parts, (1, 0) for a source that is a part of the target.
 *
 * (e122) prints H, the larger of both: what the part lacks would decide. It has to be
 * the distance directed from the part to the whole.
 */
struct Weights {
  float source_to_target, target_to_source;
};

/** \brief Whether an energy is of the largest distances: these count however long they
 * are, and a single point decides. */
constexpr bool
isOfLargest(Energy energy)
{
  return energy == Energy::HAUSDORFF;
}

/** \brief The energy of a candidate: E_d of (e9), E_cd of (e122), or what takes their
 * place. */
float
energyOf(const DirectedDistances& distances, const Weights& weights, Energy energy);

} // namespace kss
} // namespace pcl
