/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include <pcl/console/print.h>
#include <pcl/registration/kss/distances.h>
#include <pcl/registration/kss/opencl_devices.h>

#include <atomic>

namespace pcl {
namespace kss {
namespace {

std::unique_ptr<DistanceEvaluator>
onHost(const Settings& settings)
{
  return settings.search == Search::LOOK_UP
             ? makeHostLookUpEvaluator(settings.threads, settings.search_points)
             : makeHostEvaluator(settings.threads);
}

std::unique_ptr<DistanceEvaluator>
onDevice(const Settings& settings)
{
  return settings.search == Search::LOOK_UP
             ? makeOpenCLLookUpEvaluator(settings.device, settings.threads,
                                         settings.search_points)
             : makeOpenCLEvaluator(settings.device, settings.threads);
}

} // namespace

std::unique_ptr<DistanceEvaluator>
makeEvaluator(const Settings& settings)
{
  if (settings.device == "host")
    return onHost(settings);
  try {
    return onDevice(settings);
  }
  catch (const DeviceError& error) {
    if (settings.device != "auto")
      throw;
    static std::atomic<bool> warned{false};
    if (!warned.exchange(true))
      PCL_WARN("[pcl::KSSICP] %s The search runs on the host instead, more slowly.\n",
               error.what());
    return onHost(settings);
  }
}

} // namespace kss
} // namespace pcl
