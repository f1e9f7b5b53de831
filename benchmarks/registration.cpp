/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

// The whole registration by KSSICP: a new object, both clouds, align().

#include "registration.h"

#include "judgement.h"
#include "sizes.h"

namespace benchmarks {

void
warmUp()
{
  static const bool warm = [] {
    const Pair& pair = pairOf(5000);
    KSSICP kss_icp;
    kss_icp.setInputSource(pair.source);
    kss_icp.setInputTarget(pair.target);
    Cloud aligned;
    kss_icp.align(aligned);
    return true;
  }();
  benchmark::DoNotOptimize(warm);
}

namespace {

void
registerPair(benchmark::State& state, pcl::kss::Mode mode, bool estimate_scale)
{
  warmUp();
  const Pair& pair = pairOf(state.range(0));
  Eigen::Matrix4f pose = Eigen::Matrix4f::Identity();
  for (auto _ : state) {
    KSSICP kss_icp;
    kss_icp.setMode(mode);
    kss_icp.setScaleEstimation(estimate_scale);
    kss_icp.setInputSource(pair.source);
    kss_icp.setInputTarget(pair.target);
    Cloud aligned;
    kss_icp.align(aligned);
    pose = kss_icp.getFinalTransformation();
  }
  judge(state, pose, pair);
}

// as it comes: the scale is unknown
void
Automatic(benchmark::State& state)
{
  registerPair(state, pcl::kss::Mode::AUTOMATIC, true);
}
BENCHMARK(Automatic)->Apply(smallSizes);
BENCHMARK(Automatic)->Apply(largeSizes);

void
GlobalGlobal(benchmark::State& state)
{
  registerPair(state, pcl::kss::Mode::GLOBAL_GLOBAL, true);
}
BENCHMARK(GlobalGlobal)->Apply(smallSizes);
BENCHMARK(GlobalGlobal)->Apply(largeSizes);

// as much as SAC-IA is told: the scale is 1
void
AutomaticRigid(benchmark::State& state)
{
  registerPair(state, pcl::kss::Mode::AUTOMATIC, false);
}
BENCHMARK(AutomaticRigid)->Apply(smallSizes);
BENCHMARK(AutomaticRigid)->Apply(largeSizes);

void
GlobalGlobalRigid(benchmark::State& state)
{
  registerPair(state, pcl::kss::Mode::GLOBAL_GLOBAL, false);
}
BENCHMARK(GlobalGlobalRigid)->Apply(smallSizes);
BENCHMARK(GlobalGlobalRigid)->Apply(largeSizes);

} // namespace
} // namespace benchmarks
