/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "evaluators/device_or_host.h"

#include "support/warn.h"

#include <atomic>
#include <string>

#include <unistd.h>

namespace pcl {
namespace kss {

void
warnOfHost(const DeviceError& error)
{
  static std::atomic<pid_t> warned{0};
  if (warned.exchange(getpid()) != getpid())
    warn(std::string(error.what()) +
         " The search runs on the host instead, more slowly.");
}

} // namespace kss
} // namespace pcl
