/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/candidates.h>
#include <pcl/registration/kss/distances.h>
#include <pcl/registration/kss/settings.h>

#include <vector>

namespace pcl {
namespace kss {

/** \brief The scales that a pose between pre-shapes may have. */
struct ScaleRange {
  double smallest = 1.0;
  double largest = 1.0;

  /** \brief The scale of the range that is nearest to another. */
  double
  clamp(double scale) const
  {
    return std::min(std::max(scale, smallest), largest);
  }
};

/** \brief How much the two directed distances count in an energy: (1, 1) for clouds
 * that share what they share, (1, 0) for the directed energy (e122) of a source that is
 * a part of the target.
 */
struct Weights {
  float source_to_target, target_to_source;
};

/** \brief The energy of a candidate. */
float
energyOf(const DirectedDistances& distances, const Weights& weights, Energy energy);

/** \brief Candidates, and the energies whose minima are wanted. */
struct Sweep {
  Candidates candidates;
  std::vector<Weights> energies;
};

/** \brief What the mode has to try.
 *
 * GLOBAL_GLOBAL: {O} at the centre and the scale of the pre-shapes, (e10).
 * PARTIAL_GLOBAL: {C} x {O} twice, the source incomplete or the target, and smaller or
 * larger scales where the scale is unknown, since a part has not the size of the whole.
 * PARTIAL_PARTIAL and AUTOMATIC: {C} x {O} and all scales; AUTOMATIC asks the same
 * distances for the minima of all energies.
 *
 * \param[in] settings mode and sets of candidates
 * \param[in] source points of a pre-shape
 * \param[in] target points of a pre-shape
 * \param[in] scales scales to consider
 */
std::vector<Sweep>
sweepsOf(const Settings& settings,
         const Points& source,
         const Points& target,
         const ScaleRange& scales);

} // namespace kss
} // namespace pcl
