/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/candidate_rotations.h>

#include <vector>

namespace pcl {
namespace kss {

/** \brief The distinct local minima {O_local} of (e12), by rising energy: rotations
 * none of whose neighbours has a lower energy.
 *
 * Of rotations that differ by less than \a distinct_angle (the Euler grid holds most
 * rotations twice) one is kept. The first is O_init of (e10).
 *
 * \param[in] energies an energy per candidate
 * \param[in] candidates the candidates
 * \param[in] kernel edge of the kernel in steps; odd
 * \param[in] distinct_angle radians
 * \return indices into the candidates; never empty unless there are none
 */
std::vector<std::size_t>
localMinima(const std::vector<float>& energies,
            const CandidateRotations& candidates,
            unsigned int kernel,
            double distinct_angle);

} // namespace kss
} // namespace pcl
