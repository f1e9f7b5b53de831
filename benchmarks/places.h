/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "ray_casting.h"

/** Where the scans are made: another street and another room with every seed. Lengths
 * are metres.
 */
namespace benchmarks {

/** \brief A street along the x axis, some 120 m of it, and the place of a car that
 * drives there.
 * \param[in] car its x
 */
Place
street(unsigned int seed, double car);

/** \brief A furnished room with a corner at the origin, of roomSize(). */
Place
room(unsigned int seed);

inline Eigen::Vector3d
roomSize()
{
  return {5.2, 4.1, 2.6};
}

} // namespace benchmarks
