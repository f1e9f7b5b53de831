/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include <pcl/console/print.h>
#include <pcl/registration/kss/distance_bounds.h>
#include <pcl/registration/kss/distances.h>
#include <pcl/registration/kss/opencl_devices.h>

#include "evaluator_choice.h"
#include "shift_sums.h"

#include <atomic>

namespace pcl {
namespace kss {
namespace {

/** The work on the device that the settings name; where that is any, and there is none,
 * on the host, with one warning. */
template <typename OnHost, typename OnDevice>
auto
chosen(const Settings& settings, const OnHost& on_host, const OnDevice& on_device)
{
  if (settings.device == "host")
    return on_host();
  try {
    return on_device();
  }
  catch (const DeviceError& error) {
    if (settings.device != "auto")
      throw;
    static std::atomic<bool> warned{false};
    if (!warned.exchange(true))
      PCL_WARN("[pcl::KSSICP] %s The search runs on the host instead, more slowly.\n",
               error.what());
    return on_host();
  }
}

} // namespace

std::unique_ptr<DistanceEvaluator>
makeEvaluator(const Settings& settings)
{
  return chosen(
      settings, [&] { return makeHostEvaluator(settings.threads); },
      [&] { return makeOpenCLEvaluator(settings.device, settings.threads); });
}

std::unique_ptr<DistanceEvaluator>
makeLookUpEvaluator(const Settings& settings)
{
  const unsigned int threads = settings.threads, probes = settings.search_points;
  return chosen(
      settings, [&] { return makeHostLookUpEvaluator(threads, probes); },
      [&] { return makeOpenCLLookUpEvaluator(settings.device, threads, probes); });
}

std::unique_ptr<BoundsEvaluator>
makeBoundsEvaluator(const Settings& settings)
{
  return chosen(
      settings, [&] { return makeHostBoundsEvaluator(settings.threads); },
      [&] { return makeOpenCLBoundsEvaluator(settings.device, settings.threads); });
}

std::unique_ptr<ShiftSums>
makeShiftSums(const Settings& settings)
{
  return chosen(
      settings, [&] { return makeHostShiftSums(settings.threads); },
      [&] { return makeOpenCLShiftSums(settings.device, settings.threads); });
}

} // namespace kss
} // namespace pcl
