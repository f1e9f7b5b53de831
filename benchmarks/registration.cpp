/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

// The whole registration by KSSICP of the sampled surface, at all sizes.

#include "registration.h"

#include "judgement.h"
#include "sizes.h"

namespace benchmarks {

using pcl::kss::Mode;
using pcl::kss::Settings;

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

void
registerPair(benchmark::State& state, const Pair& pair, const Settings& settings)
{
  warmUp();
  Eigen::Matrix4f pose = Eigen::Matrix4f::Identity();
  for (auto _ : state) {
    KSSICP kss_icp;
    kss_icp.setSettings(settings);
    kss_icp.setInputSource(pair.source);
    kss_icp.setInputTarget(pair.target);
    Cloud aligned;
    kss_icp.align(aligned);
    pose = kss_icp.getFinalTransformation();
    state.counters["converged"] = kss_icp.hasConverged();
  }
  judge(state, pose, pair);
}

namespace {

void
registerSurface(benchmark::State& state, Mode mode, bool estimate_scale)
{
  Settings settings = KSSICP().getSettings();
  settings.mode = mode;
  settings.estimate_scale = estimate_scale;
  registerPair(state, pairOf(state.range(0)), settings);
}

// as it comes: the scale is unknown
void
Automatic(benchmark::State& state)
{
  registerSurface(state, Mode::AUTOMATIC, true);
}
BENCHMARK(Automatic)->Apply(smallSizes);
BENCHMARK(Automatic)->Apply(largeSizes);

void
GlobalGlobal(benchmark::State& state)
{
  registerSurface(state, Mode::GLOBAL_GLOBAL, true);
}
BENCHMARK(GlobalGlobal)->Apply(smallSizes);
BENCHMARK(GlobalGlobal)->Apply(largeSizes);

// as much as SAC-IA is told: the scale is 1
void
AutomaticRigid(benchmark::State& state)
{
  registerSurface(state, Mode::AUTOMATIC, false);
}
BENCHMARK(AutomaticRigid)->Apply(smallSizes);
BENCHMARK(AutomaticRigid)->Apply(largeSizes);

void
GlobalGlobalRigid(benchmark::State& state)
{
  registerSurface(state, Mode::GLOBAL_GLOBAL, false);
}
BENCHMARK(GlobalGlobalRigid)->Apply(smallSizes);
BENCHMARK(GlobalGlobalRigid)->Apply(largeSizes);

// without OpenCL
void
AutomaticHost(benchmark::State& state)
{
  Settings settings = KSSICP().getSettings();
  settings.device = "host";
  registerPair(state, pairOf(state.range(0)), settings);
}
BENCHMARK(AutomaticHost)->Apply([](benchmark::internal::Benchmark* benchmark) {
  timed(benchmark, 5);
  benchmark->Arg(10000);
});

// What a second thread gains, in wall time; these heed no --threads.
void
registerByThreads(benchmark::State& state, unsigned int threads)
{
  Settings settings = KSSICP().getSettings();
  settings.threads = threads;
  registerPair(state, pairOf(state.range(0)), settings);
}

void
AutomaticOneThread(benchmark::State& state)
{
  registerByThreads(state, 1);
}
BENCHMARK(AutomaticOneThread)->Apply(someSizes);

void
AutomaticTwoThreads(benchmark::State& state)
{
  registerByThreads(state, 2);
}
BENCHMARK(AutomaticTwoThreads)->Apply(someSizes);

} // namespace
} // namespace benchmarks
