/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include <pcl/registration/kss/detail/warnings.h>

#include <pcl/console/print.h>

namespace pcl {
namespace kss {
namespace {

void
showByPCL(const char* warning)
{
  PCL_WARN("[pcl::KSSICP] %s\n", warning);
}

} // namespace

void
showWarningsByPCL()
{
  if (!warningSink())
    setWarningSink(showByPCL);
}

} // namespace kss
} // namespace pcl
