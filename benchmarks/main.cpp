/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "fresh_process.h"

#include <benchmark/benchmark.h>

int
main(int argc, char** argv)
{
  if (benchmarks::isFreshProcess(argc, argv))
    return 0;
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv))
    return 1;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
