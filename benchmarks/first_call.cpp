/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

// The first registration of a new process, once with no kernel compiled before. The
// time is what the new process measures around the registration; the clouds are made
// before.

#include "fresh_process.h"

#include <benchmark/benchmark.h>

#include <filesystem>
#include <stdexcept>

#include <stdlib.h>

namespace benchmarks {
namespace {

/** \brief An empty folder that goes away with everything in it. */
class EmptyFolder {
public:
  EmptyFolder()
  {
    std::string name =
        (std::filesystem::temp_directory_path() / "pcl_kss_icp_XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr)
      throw std::runtime_error("no temporary folder");
    path_ = name;
  }

  ~EmptyFolder()
  {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }

  EmptyFolder(const EmptyFolder&) = delete;
  EmptyFolder&
  operator=(const EmptyFolder&) = delete;

  const std::string&
  path() const
  {
    return path_;
  }

private:
  std::string path_;
};

void
report(benchmark::State& state, const FirstCall& call)
{
  state.SetIterationTime(call.wall_seconds);
  state.counters["wall_s"] = call.wall_seconds;
  state.counters["cpu_s"] = call.cpu_seconds;
  if (!call.solved)
    state.SkipWithError("not solved");
}

void
FirstCallColdCache(benchmark::State& state)
{
  for (auto _ : state) {
    const EmptyFolder cache;
    report(state, registerInFreshProcess(pcl::kss::Mode::AUTOMATIC, state.range(0),
                                         cache.path()));
  }
}

void
FirstCallWarmCache(benchmark::State& state)
{
  const EmptyFolder cache;
  registerInFreshProcess(pcl::kss::Mode::AUTOMATIC, state.range(0), cache.path());
  for (auto _ : state)
    report(state, registerInFreshProcess(pcl::kss::Mode::AUTOMATIC, state.range(0),
                                         cache.path()));
}

void
settings(benchmark::internal::Benchmark* benchmark)
{
  benchmark->Arg(10000)
      ->UseManualTime()
      ->Unit(benchmark::kMillisecond)
      ->Iterations(1)
      ->Repetitions(3);
}
BENCHMARK(FirstCallColdCache)->Apply(settings);
BENCHMARK(FirstCallWarmCache)->Apply(settings);

} // namespace
} // namespace benchmarks
