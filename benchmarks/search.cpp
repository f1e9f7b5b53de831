/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

// The paper's search with 2000 points, exactly: by bounds, and from all pairs of
// points. For complete clouds 1728 candidates, for a part and a whole 125 centres of
// each cloud times 1728. The time is that of the whole registration; the search alone
// is the counter search_s, wall time.

#include "search/candidate_search.h"

#include "judgement.h"
#include "registration.h"
#include "sizes.h"

namespace benchmarks {
namespace {

void
search(benchmark::State& state, pcl::kss::Mode mode, pcl::kss::Search search)
{
  const Pair& pair = pairOf(state.range(0));
  KSSICP kss_icp;
  pcl::kss::Settings settings = pcl::kss::paperSettings(kss_icp.getSettings());
  settings.mode = mode;
  settings.search = search;
  kss_icp.setSettings(settings);
  Cloud aligned;
  for (auto _ : state) {
    kss_icp.setInputSource(pair.source);
    kss_icp.setInputTarget(pair.target);
    kss_icp.align(aligned);
  }
  for (const pcl::kss::StageSeconds& stage : kss_icp.getStageSeconds())
    if (stage.stage == "search")
      state.counters["search_s"].value += stage.seconds;
  judge(state, kss_icp.getFinalTransformation(), pair);
}

void
CompleteByBounds(benchmark::State& state)
{
  search(state, pcl::kss::Mode::GLOBAL_GLOBAL, pcl::kss::Search::EXACT);
}
BENCHMARK(CompleteByBounds)->Apply(tenThousand);

void
CompleteByBruteForce(benchmark::State& state)
{
  search(state, pcl::kss::Mode::GLOBAL_GLOBAL, pcl::kss::brute_force);
}
BENCHMARK(CompleteByBruteForce)->Apply(tenThousand);

void
PartialByBounds(benchmark::State& state)
{
  search(state, pcl::kss::Mode::PARTIAL_GLOBAL, pcl::kss::Search::EXACT);
}
BENCHMARK(PartialByBounds)->Apply(tenThousand);

void
PartialByBruteForce(benchmark::State& state)
{
  search(state, pcl::kss::Mode::PARTIAL_GLOBAL, pcl::kss::brute_force);
}
BENCHMARK(PartialByBruteForce)->Apply([](benchmark::internal::Benchmark* benchmark) {
  timed(benchmark, 1); // minutes
  benchmark->Arg(10000);
});

} // namespace
} // namespace benchmarks
