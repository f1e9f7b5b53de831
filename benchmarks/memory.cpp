/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

// How much memory one registration takes at its peak, beyond the clouds themselves: in
// a new process, in which OpenCL is not there yet.

#include "fresh_process.h"
#include "registration.h"
#include "sizes.h"

namespace benchmarks {
namespace {

void
registerPair(benchmark::State& state, pcl::kss::Mode mode)
{
  warmUp(); // compiled kernels are kept on disk
  FirstCall call;
  for (auto _ : state)
    call = registerInFreshProcess(mode, state.range(0), "");
  state.counters["peak_MB"] = 1e-6 * call.peak_bytes;
  if (!call.solved)
    state.SkipWithError("not solved");
}

void
MemoryAutomatic(benchmark::State& state)
{
  registerPair(state, pcl::kss::Mode::AUTOMATIC);
}
BENCHMARK(MemoryAutomatic)->Apply(twoSizesOnce);

void
MemoryGlobalGlobal(benchmark::State& state)
{
  registerPair(state, pcl::kss::Mode::GLOBAL_GLOBAL);
}
BENCHMARK(MemoryGlobalGlobal)->Apply(twoSizesOnce);

} // namespace
} // namespace benchmarks
