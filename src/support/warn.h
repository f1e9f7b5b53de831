/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <string>

namespace pcl {
namespace kss {

/** \brief Have a warning shown: setWarningSink(). */
void
warn(const std::string& warning);

} // namespace kss
} // namespace pcl
