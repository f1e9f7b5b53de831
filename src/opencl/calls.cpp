/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "opencl/calls.h"

#include <atomic>

#include <unistd.h>

namespace pcl {
namespace kss {
namespace {

/** The process that called OpenCL first, this one or an ancestor; 0: none yet. Told
 * apart without a lock, since a child may inherit one that nobody will release. */
std::atomic<pid_t> first_caller{0};

} // namespace

bool
isForkedFromOpenCL()
{
  const pid_t caller = first_caller;
  return caller != 0 && caller != getpid();
}

void
enterOpenCL()
{
  pid_t none = 0;
  first_caller.compare_exchange_strong(none, getpid());
  if (isForkedFromOpenCL())
    throw DeviceError("This process was forked from one that had used OpenCL, whose "
                      "drivers do not survive that. Choose the device \"host\", or "
                      "start the process anew (fork and exec).");
}

std::string
failureOf(const std::string& who, const cl::Error& error)
{
  return who + " failed in " + error.what() + " with error " +
         std::to_string(error.err());
}

} // namespace kss
} // namespace pcl
