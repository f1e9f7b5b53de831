/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/settings.h>

#include "candidates/candidates.h"
#include "candidates/energy.h"
#include "candidates/grain.h"
#include "geometry/scale_range.h"

#include <vector>

namespace pcl {
namespace kss {

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
 * IN_SCENE, or where the grain says so: {C} of the larger cloud, and distances from the
 * smaller one alone.
 *
 * \param[in] settings mode and sets of candidates
 * \param[in] source points of a pre-shape
 * \param[in] target points of a pre-shape
 * \param[in] scales scales to consider
 * \param[in] grain how close centres lie
 */
std::vector<Sweep>
sweepsOf(const Settings& settings,
         const Points& source,
         const Points& target,
         const ScaleRange& scales,
         const Grain& grain);

} // namespace kss
} // namespace pcl
