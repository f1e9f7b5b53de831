/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "support/warn.h"

#include <pcl/registration/kss/detail/warnings.h>

#include <atomic>
#include <cstdio>

namespace pcl {
namespace kss {
namespace {

std::atomic<WarningSink> warning_sink{nullptr};

} // namespace

void
setWarningSink(WarningSink sink)
{
  warning_sink = sink;
}

WarningSink
warningSink()
{
  return warning_sink;
}

void
warn(const std::string& warning)
{
  if (const WarningSink sink = warning_sink)
    sink(warning.c_str());
  else
    std::fprintf(stderr, "[kss] %s\n", warning.c_str());
}

} // namespace kss
} // namespace pcl
