/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "evaluators/distance_evaluator.h"

#include <memory>
#include <string>

namespace pcl {
namespace kss {

/** \brief All pairs of points on the host: the reference.
 * \param[in] threads 0: as many as there are cores
 */
std::unique_ptr<DistanceEvaluator>
makeHostPairDistances(unsigned int threads);

/** \brief All pairs of points on an OpenCL device.
 * \param[in] device part of a name, or "auto": see Settings::device
 * \param[in] threads compute units to use of a CPU device; 0: all
 * \throws DeviceError where there is no such device or it does not work
 */
std::unique_ptr<DistanceEvaluator>
makeOpenCLPairDistances(const std::string& device, unsigned int threads);

} // namespace kss
} // namespace pcl
