/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "evaluators/device_or_host.h"

#include <pcl/console/print.h>

#include <atomic>

#include <unistd.h>

namespace pcl {
namespace kss {

void
warnOfHost(const DeviceError& error)
{
  static std::atomic<pid_t> warned{0};
  if (warned.exchange(getpid()) != getpid())
    PCL_WARN("[pcl::KSSICP] %s The search runs on the host instead, more slowly.\n",
             error.what());
}

} // namespace kss
} // namespace pcl
