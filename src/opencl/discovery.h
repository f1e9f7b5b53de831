/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "opencl/calls.h"

#include <string>
#include <vector>

namespace pcl {
namespace kss {

/** \brief A device as the user knows it. */
struct NamedDevice {
  cl::Device device;
  std::string name; ///< "device (platform)"
  std::string platform;
  bool is_cpu = false, is_gpu = false;
};

/** \brief The devices that a name stands for, at least one.
 * \param[in] wanted see openCLPrograms()
 * \throws DeviceError
 */
std::vector<NamedDevice>
findDevices(const std::string& wanted);

/** \brief So many compute units of a CPU device; the whole device where it cannot be
 * divided.
 * \throws DeviceError
 */
cl::Device
partOf(const NamedDevice& whole, unsigned int threads);

} // namespace kss
} // namespace pcl
