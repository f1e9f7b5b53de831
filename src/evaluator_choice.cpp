/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include <pcl/console/print.h>
#include <pcl/registration/kss/hausdorff.h>
#include <pcl/registration/kss/opencl_devices.h>

#include <atomic>

namespace pcl {
namespace kss {

std::unique_ptr<HausdorffEvaluator>
makeEvaluator(const Settings& settings)
{
  if (settings.device == "host")
    return makeHostEvaluator(settings.threads);
  try {
    return makeOpenCLEvaluator(settings.device, settings.threads);
  }
  catch (const DeviceError& error) {
    if (settings.device != "auto")
      throw;
    static std::atomic<bool> warned{false};
    if (!warned.exchange(true))
      PCL_WARN("[pcl::KSSICP] %s The search runs on the host instead, more slowly.\n",
               error.what());
    return makeHostEvaluator(settings.threads);
  }
}

} // namespace kss
} // namespace pcl
