/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/settings.h>

#include "evaluators/bounds.h"
#include "evaluators/distance_evaluator.h"
#include "evaluators/shift_sums.h"

#include <memory>

namespace pcl {
namespace kss {

/** \brief All pairs of points, where the settings say: with the device "auto" the host
 * takes over, with one warning, where no OpenCL device can be had, and when it fails.
 * \throws DeviceError where a device asked for by name cannot be had; so do its calls
 *   where it fails
 */
std::unique_ptr<DistanceEvaluator>
makePairDistances(const Settings& settings);

/** \brief Look-ups of the first Settings::search_points of each cloud, where the
 * settings say; as makePairDistances().
 */
std::unique_ptr<DistanceEvaluator>
makeLookUps(const Settings& settings);

/** \brief Bounds, where the settings say; as makePairDistances(). */
std::unique_ptr<BoundsEvaluator>
makeBounds(const Settings& settings);

/** \brief Sums, where the settings say; as makePairDistances(). */
std::unique_ptr<ShiftSums>
makeShiftSums(const Settings& settings);

} // namespace kss
} // namespace pcl
