/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/settings.h>

#include <string>

namespace tool {

/** \brief The OpenCL devices and the host, a line each, with a star before those on
 * which a registration with these settings runs: a small one has been tried, since a
 * driver may be there and not work.
 * \throws std::runtime_error where it cannot run at all
 */
std::string
deviceList(const pcl::kss::Settings& settings);

/** \brief Check that there is such a device.
 * \throws std::runtime_error where there is none
 */
void
checkDevice(const std::string& device);

} // namespace tool
