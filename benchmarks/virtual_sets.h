/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "places.h"
#include "virtual_scan.h"

#include <cstddef>
#include <string>
#include <vector>

/** What the virtual scanners look at. All scans are in the frames of their scanners; a
 * number of scans of 0 asks for as many as the thing takes.
 */
namespace benchmarks {

/** \brief Objects of 0.2 m on a turntable, one after the other, some 30,000 points a
 * view, whose depths are off by 0.2 mm.
 * \param[in] models mesh files; none: one object made up
 */
VirtualScans
turntableScans(const std::vector<std::string>& models,
               std::size_t scans,
               unsigned int seed);

/** \brief Streets around a block of houses, by a lidar on a car: 40 scans, 6 m apart,
 * the last beside the first.
 */
VirtualScans
loopScans(std::size_t scans, unsigned int seed);

/** \brief A street there and back on the other lane, by a lidar on a car. */
VirtualScans
streetScans(std::size_t scans, unsigned int seed);

/** \brief Rooms that doors connect, by a scanner on a tripod: in each room, and in the
 * doors on the way.
 */
VirtualScans
buildingScans(Rooms rooms, std::size_t scans, unsigned int seed);

/** \brief A room by a depth camera that moves on and turns. */
VirtualScans
roomScans(std::size_t scans, unsigned int seed, const RoomPlan& plan = {});

/** \brief Five objects and two rooms of different plans, four to six scans of each.
 * \param[in] models mesh files; none: objects made up
 */
VirtualScans
bagScans(const std::vector<std::string>& models, unsigned int seed);

} // namespace benchmarks
