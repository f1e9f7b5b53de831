/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/settings.h>

#include "candidates/sweeps.h"
#include "evaluators/distance_evaluator.h"
#include "search/exact/known_distances.h"

#include <vector>

namespace pcl {
namespace kss {

/** \brief A candidate and its energy. */
struct FoundMinimum {
  std::size_t candidate;
  float energy;
};

/** \brief The local minima {(c, O)_local} of the additional process (e12), the first of
 * them (c_init, O_init) of (e10) or (e13): those that brute force finds, in the same
 * order and with the same energies, bit for bit.
 *
 * A candidate is none if its energy's lower bound lies above the upper bound of a
 * neighbour. All start with bounds from few points; those that cannot be told apart get
 * closer and closer bounds, and the last of them their energies.
 *
 * \param[in] settings energy, kernel of local minima, device and threads
 * \param[in] sweep candidates, and weights of the energies
 * \param[in] distinct_angle as of Candidates::localMinima()
 * \param[in] source the cloud that is placed
 * \param[in] target the cloud it is placed upon
 * \param[in] limit what a distance counts in the means at most
 * \param[in] distances where the clouds and the limit have been set; brute force
 * \param[out] effort what it took, if not null
 * \return the minima of each energy of the sweep, by rising energy
 */
std::vector<std::vector<FoundMinimum>>
exactMinima(const Settings& settings,
            const Sweep& sweep,
            double distinct_angle,
            const Points& source,
            const Points& target,
            float limit,
            DistanceEvaluator& distances,
            SearchEffort* effort = nullptr);

} // namespace kss
} // namespace pcl
