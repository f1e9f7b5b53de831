/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

// What is done for each two of many scans by the one process that knows them all: it
// grows with the square of their number, however many others help. Scans are those of a
// street.

#include "virtual_sets.h"

#include "multiview/pair_choice.h"
#include "multiview/placement_of_scans.h"

#include <benchmark/benchmark.h>

#include <stdexcept>
#include <utility>
#include <vector>

namespace benchmarks {
namespace {

using namespace pcl::kss;

constexpr std::size_t scans = 16;

/** \brief What the scans are like, and where they are. */
struct Street {
  std::vector<ScanDescription> descriptions;
  std::vector<Eigen::Matrix4d> poses;
};

const Street&
street()
{
  static const Street once = [] {
    Street made;
    const VirtualScans virtual_scans = streetScans(scans, 1);
    Settings settings;
    settings.estimate_scale = false;
    settings.threads = 1;
    ScanWorker worker(
        settings,
        [&](std::size_t number) {
          const auto points = tool::positionsOf(virtual_scans[number].geometry);
          const auto cloud = std::make_shared<pcl::kss::Cloud>();
          cloud->points.resize(3, points.size());
          for (std::size_t i = 0; i < points.size(); ++i)
            cloud->points.col(i) = points[i];
          return cloud;
        },
        100000000);
    for (std::size_t i = 0; i < scans; ++i) {
      ScanTask task;
      task.source = i;
      ScanAnswer answer = worker.answer(task);
      if (answer.failure.cause != FailureCause::NONE)
        throw std::runtime_error(answer.failure.reason);
      made.descriptions.push_back(std::move(answer.description));
      made.poses.push_back(virtual_scans[i].pose.matrix());
    }
    return made;
  }();
  return once;
}

template <typename Function>
void
forEachPair(benchmark::State& state, const Function& function)
{
  street();
  for (auto _ : state)
    for (std::size_t a = 0; a < scans; ++a)
      for (std::size_t b = a + 1; b < scans; ++b)
        benchmark::DoNotOptimize(function(a, b));
  state.SetItemsProcessed(
      static_cast<std::int64_t>(state.iterations() * scans * (scans - 1) / 2));
  const ScanDescription& one = street().descriptions.front();
  state.counters["bytes_of_description"] =
      static_cast<double>(2 * sizeof(LocalFeature) * one.wide_features.size() +
                          sizeof(Eigen::Vector3f) * one.outline.size());
}

void
resemblances(benchmark::State& state)
{
  forEachPair(state, [](std::size_t a, std::size_t b) {
    return resemblance(street().descriptions[a], street().descriptions[b]);
  });
}

void
overlaps(benchmark::State& state)
{
  forEachPair(state, [](std::size_t a, std::size_t b) {
    return expectedOverlap(street().descriptions[a], street().descriptions[b],
                           inverted(street().poses[b]) * street().poses[a]);
  });
}

/** \brief Of scans far apart, which most of many are. */
void
distantOverlaps(benchmark::State& state)
{
  Eigen::Matrix4d away = Eigen::Matrix4d::Identity();
  away(0, 3) = 1e4;
  forEachPair(state, [&away](std::size_t a, std::size_t b) {
    return expectedOverlap(street().descriptions[a], street().descriptions[b], away);
  });
}

BENCHMARK(resemblances)->Name("Resemblances")->Unit(benchmark::kMillisecond);
BENCHMARK(overlaps)->Name("ExpectedOverlaps")->Unit(benchmark::kMillisecond);
BENCHMARK(distantOverlaps)->Name("DistantOverlaps")->Unit(benchmark::kMillisecond);

} // namespace
} // namespace benchmarks
