/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "evaluators/distance_evaluator.h"

#include <memory>
#include <string>

namespace pcl {
namespace kss {

/** \brief Look-ups in distance fields on the host.
 *
 * A distance is that of the centre of the field's cell that a point falls into, within
 * the field, whose margin is twice as wide as the limit. It is too short by half a
 * diagonal of a cell at most. It is seldom too long by more, since few cells miss their
 * nearest point by much (see DistanceField); for sure it is no longer than sqrt(3)
 * times the true one and 2.3 diagonals.
 * \param[in] threads 0: as many as there are cores
 * \param[in] probes points of each cloud, the first ones, whose distances are looked
 * up
 */
std::unique_ptr<DistanceEvaluator>
makeHostLookUps(unsigned int threads, unsigned int probes);

/** \brief Look-ups in distance fields on an OpenCL device: as on the host.
 * \param[in] device part of a name, or "auto": see Settings::device
 * \param[in] threads compute units to use of a CPU device; 0: all
 * \param[in] probes points of each cloud, the first ones, whose distances are looked
 * up
 * \throws DeviceError where there is no such device or it does not work
 */
std::unique_ptr<DistanceEvaluator>
makeOpenCLLookUps(const std::string& device, unsigned int threads, unsigned int probes);

} // namespace kss
} // namespace pcl
