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

/** \brief Four streets around a block of houses, whose middle lines are a square about
 * the origin, blockRadius() away from it, and a car that drives there.
 */
Place
block(unsigned int seed, const Eigen::Vector2d& car, double yaw);

inline double
blockRadius()
{
  return 30.0;
}

/** \brief Furnished rooms, buildingRooms() of them along x and y, each of
 * buildingRoomSize(), the first with a corner at the origin; neighbours have a door
 * between them.
 */
Place
building(unsigned int seed);

inline Eigen::Vector2i
buildingRooms()
{
  return {3, 2};
}

inline Eigen::Vector3d
buildingRoomSize()
{
  return {5.0, 4.2, 2.6};
}

/** \brief A furnished room with a corner at the origin, of roomSize(). */
Place
room(unsigned int seed);

inline Eigen::Vector3d
roomSize()
{
  return {5.2, 4.1, 2.6};
}

} // namespace benchmarks
