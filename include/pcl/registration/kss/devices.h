/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/export.h>

#include <stdexcept>
#include <string>
#include <vector>

namespace pcl {
namespace kss {

/** \brief No such OpenCL device, or one that does not work. */
class PCL_KSS_ICP_EXPORT DeviceError : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

/** \brief The names of all OpenCL devices of this machine, "device (platform)"; none in
 * a process forked from one that has used OpenCL, since no driver survives that.
 */
PCL_KSS_ICP_EXPORT std::vector<std::string>
openCLDeviceNames();

} // namespace kss
} // namespace pcl
