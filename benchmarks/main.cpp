/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "fresh_process.h"
#include "options.h"
#include "written_clouds.h"

#include <benchmark/benchmark.h>

int
main(int argc, char** argv)
{
  if (!benchmarks::takeOptions(argc, argv))
    return 1;
  if (benchmarks::isFreshProcess(argc, argv))
    return 0;
  if (!benchmarks::options().clouds_folder.empty())
    return benchmarks::writeClouds(benchmarks::options().clouds_folder) ? 0 : 1;
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv))
    return 1;
  benchmark::AddCustomContext("threads", std::to_string(benchmarks::options().threads));
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
