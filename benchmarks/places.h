/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "ray_casting.h"

#include <vector>

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

/** \brief How the rooms of a building differ in size. */
enum class Rooms {
  DIFFERENT,
  EQUAL ///< by their walls alone nobody can tell them apart
};

/** \brief Where the walls of a building are, along x (0) or y (1). */
inline std::vector<double>
buildingWalls(Rooms rooms, int axis)
{
  if (rooms == Rooms::EQUAL)
    return axis == 0 ? std::vector<double>{0.0, 5.0, 10.0, 15.0}
                     : std::vector<double>{0.0, 4.2, 8.4};
  return axis == 0 ? std::vector<double>{0.0, 4.4, 10.2, 15.0}
                   : std::vector<double>{0.0, 4.9, 8.6};
}

/** \brief Furnished rooms between buildingWalls(), 2.6 m high, with a door in the
 * middle of each wall between two of them.
 */
Place
building(unsigned int seed, Rooms rooms);

/** \brief The shell of a room. */
struct RoomPlan {
  Eigen::Vector3d size{5.2, 4.1, 2.6};
  bool has_chimney = false; ///< beside the bookcase; it takes 4.3 m of depth
};

/** \brief A plan that nobody takes for the usual one. */
inline RoomPlan
largeRoom()
{
  return {{6.9, 5.3, 3.1}, true};
}

/** \brief A furnished room with a corner at the origin. */
Place
room(unsigned int seed, const RoomPlan& plan = {});

} // namespace benchmarks
