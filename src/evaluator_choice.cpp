/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "evaluator_choice.h"

#include <pcl/console/print.h>
#include <pcl/registration/kss/distance_bounds.h>
#include <pcl/registration/kss/distances.h>

#include "device_or_host.h"
#include "shift_sums.h"

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

namespace {

class AnyDistances : public DistanceEvaluator, private DeviceOrHost<DistanceEvaluator> {
public:
  using DeviceOrHost::DeviceOrHost;

  void
  setClouds(const Points& source, const Points& target, float limit) override
  {
    set([=](DistanceEvaluator& evaluator) {
      evaluator.setClouds(source, target, limit);
    });
  }

  std::vector<DirectedDistances>
  evaluate(const std::vector<Placement>& placements) override
  {
    return call(
        [&](DistanceEvaluator& evaluator) { return evaluator.evaluate(placements); });
  }

  std::string
  deviceName() const override
  {
    return evaluator().deviceName();
  }
};

class AnyBounds : public BoundsEvaluator, private DeviceOrHost<BoundsEvaluator> {
public:
  using DeviceOrHost::DeviceOrHost;

  void
  setClouds(const Points& source,
            const Points& target,
            const BoundsScope& scope) override
  {
    set([=](BoundsEvaluator& evaluator) {
      evaluator.setClouds(source, target, scope);
    });
  }

  std::vector<DistanceBounds>
  evaluate(const std::vector<Placement>& placements, Eigen::Index probes) override
  {
    return call([&](BoundsEvaluator& evaluator) {
      return evaluator.evaluate(placements, probes);
    });
  }
};

class AnyShiftSums : public ShiftSums, private DeviceOrHost<ShiftSums> {
public:
  using DeviceOrHost::DeviceOrHost;

  void
  setField(const Points& cloud, const ShiftLattice& lattice) override
  {
    set([=](ShiftSums& sums) { sums.setField(cloud, lattice); });
  }

  std::vector<std::uint16_t>
  sums(const Points& points, const std::vector<Placement>& placements) override
  {
    return call([&](ShiftSums& sums) { return sums.sums(points, placements); });
  }
};

/** The evaluator for the device that the settings name; where that is any, one that
 * goes on on the host where the device fails. */
template <typename Any, typename OnHost, typename OnDevice>
auto
chosen(const Settings& settings, const OnHost& on_host, const OnDevice& on_device)
    -> decltype(on_host())
{
  if (settings.device == "host")
    return on_host();
  if (settings.device != "auto")
    return on_device();
  return std::make_unique<Any>(on_device, on_host);
}

} // namespace

std::unique_ptr<DistanceEvaluator>
makeEvaluator(const Settings& settings)
{
  const unsigned int threads = settings.threads;
  return chosen<AnyDistances>(
      settings, [=] { return makeHostEvaluator(threads); },
      [=, device = settings.device] { return makeOpenCLEvaluator(device, threads); });
}

std::unique_ptr<DistanceEvaluator>
makeLookUpEvaluator(const Settings& settings)
{
  const unsigned int threads = settings.threads, probes = settings.search_points;
  return chosen<AnyDistances>(
      settings, [=] { return makeHostLookUpEvaluator(threads, probes); },
      [=, device = settings.device] {
        return makeOpenCLLookUpEvaluator(device, threads, probes);
      });
}

std::unique_ptr<BoundsEvaluator>
makeBoundsEvaluator(const Settings& settings)
{
  const unsigned int threads = settings.threads;
  return chosen<AnyBounds>(
      settings, [=] { return makeHostBoundsEvaluator(threads); },
      [=, device = settings.device] {
        return makeOpenCLBoundsEvaluator(device, threads);
      });
}

std::unique_ptr<ShiftSums>
makeShiftSums(const Settings& settings)
{
  const unsigned int threads = settings.threads;
  return chosen<AnyShiftSums>(
      settings, [=] { return makeHostShiftSums(threads); },
      [=, device = settings.device] { return makeOpenCLShiftSums(device, threads); });
}

} // namespace kss
} // namespace pcl
