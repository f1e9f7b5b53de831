/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

// The stages of a registration: wall seconds of each, as counters.

#include "judgement.h"
#include "registration.h"
#include "sizes.h"

#include <map>

namespace benchmarks {
namespace {

void
Stages(benchmark::State& state)
{
  warmUp();
  const Pair& pair = pairOf(state.range(0));
  KSSICP kss_icp;
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
BENCHMARK(Stages)->Apply(twoSizes);

} // namespace
} // namespace benchmarks
