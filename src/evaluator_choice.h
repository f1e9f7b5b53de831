/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/settings.h>

#include <memory>

namespace pcl {
namespace kss {

class ShiftSums;

/** \brief Sums where the settings want them: on a device, or on the host. */
std::unique_ptr<ShiftSums>
makeShiftSums(const Settings& settings);

} // namespace kss
} // namespace pcl
