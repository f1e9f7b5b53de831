/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "evaluators/evaluator_choice.h"

#include "evaluators/bounds.h"
#include "evaluators/device_or_host.h"
#include "evaluators/look_ups.h"
#include "evaluators/pair_distances.h"
#include "evaluators/shift_sums.h"

namespace pcl {
namespace kss {
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
makePairDistances(const Settings& settings)
{
  const unsigned int threads = settings.threads;
  return chosen<AnyDistances>(
      settings, [=] { return makeHostPairDistances(threads); },
      [=, device = settings.device] {
        return makeOpenCLPairDistances(device, threads);
      });
}

std::unique_ptr<DistanceEvaluator>
makeLookUps(const Settings& settings)
{
  const unsigned int threads = settings.threads, probes = settings.search_points;
  return chosen<AnyDistances>(
      settings, [=] { return makeHostLookUps(threads, probes); },
      [=, device = settings.device] {
        return makeOpenCLLookUps(device, threads, probes);
      });
}

std::unique_ptr<BoundsEvaluator>
makeBounds(const Settings& settings)
{
  const unsigned int threads = settings.threads;
  return chosen<AnyBounds>(
      settings, [=] { return makeHostBounds(threads); },
      [=, device = settings.device] { return makeOpenCLBounds(device, threads); });
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
