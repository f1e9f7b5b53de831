/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

// The stages of a registration: wall seconds of each, as counters.

#include "judgement.h"
#include "registration.h"
#include "scans.h"
#include "sizes.h"

namespace benchmarks {
namespace {

void
timeStages(benchmark::State& state, const Pair& pair, bool estimate_scale)
{
  warmUp();
  KSSICP kss_icp;
  kss_icp.setScaleEstimation(estimate_scale);
  for (auto _ : state) {
    kss_icp.setInputSource(pair.source);
    kss_icp.setInputTarget(pair.target);
    Cloud aligned;
    kss_icp.align(aligned);
  }
  for (const pcl::kss::StageSeconds& stage : kss_icp.getStageSeconds())
    state.counters[stage.stage + "_s"].value += stage.seconds;
  judge(state, kss_icp.getFinalTransformation(), pair);
}

void
Stages(benchmark::State& state)
{
  timeStages(state, pairOf(state.range(0)), true);
}
BENCHMARK(Stages)->Apply(allSizes);

void
StagesStreetRigid(benchmark::State& state)
{
  timeStages(state, streetPair(state.range(0)), false);
}
BENCHMARK(StagesStreetRigid)->Apply(allSeeds);

void
StagesRoomRigid(benchmark::State& state)
{
  timeStages(state, roomPair(state.range(0)), false);
}
BENCHMARK(StagesRoomRigid)->Apply(allSeeds);

} // namespace
} // namespace benchmarks
