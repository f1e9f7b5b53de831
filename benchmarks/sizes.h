/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <benchmark/benchmark.h>

/** The numbers of points, and how everything is timed at them. */
namespace benchmarks {

/** \brief All numbers of points. */
constexpr int sizes[] = {5000, 10000, 50000, 100000, 500000, 1000000};

/** \brief All streets and rooms. */
constexpr int seeds[] = {1, 2, 3};

/** \brief CPU time of the whole process over all threads, and wall time beside it; one
 * registration per repetition.
 * \param[in] repetitions of which the median counts
 */
inline void
timed(benchmark::internal::Benchmark* benchmark, int repetitions)
{
  benchmark->MeasureProcessCPUTime()
      ->Unit(benchmark::kMillisecond)
      ->Iterations(1)
      ->Repetitions(repetitions);
}

/** \brief The sizes at which a few repetitions are quick. */
inline void
smallSizes(benchmark::internal::Benchmark* benchmark)
{
  timed(benchmark, 5);
  benchmark->Arg(5000)->Arg(10000)->Arg(50000);
}

/** \brief The sizes at which one measurement is much work, and exact enough. */
inline void
largeSizes(benchmark::internal::Benchmark* benchmark)
{
  timed(benchmark, 1);
  benchmark->Arg(100000)->Arg(500000)->Arg(1000000);
}

/** \brief All sizes, for what is quick at all of them. */
inline void
allSizesOften(benchmark::internal::Benchmark* benchmark)
{
  timed(benchmark, 5);
  for (const int size : sizes)
    benchmark->Arg(size);
}

inline void
allSizes(benchmark::internal::Benchmark* benchmark)
{
  timed(benchmark, 3);
  for (const int size : sizes)
    benchmark->Arg(size);
}

/** \brief The argument is not a number of points. */
inline void
allSeeds(benchmark::internal::Benchmark* benchmark)
{
  timed(benchmark, 3);
  benchmark->ArgName("seed");
  for (const int seed : seeds)
    benchmark->Arg(seed);
}

inline void
someSizes(benchmark::internal::Benchmark* benchmark)
{
  timed(benchmark, 3);
  benchmark->Arg(10000)->Arg(100000)->Arg(1000000);
}

/** \brief For what does not vary: memory. */
inline void
twoSizesOnce(benchmark::internal::Benchmark* benchmark)
{
  timed(benchmark, 1);
  benchmark->Arg(10000)->Arg(1000000);
}

inline void
tenThousand(benchmark::internal::Benchmark* benchmark)
{
  timed(benchmark, 3);
  benchmark->Arg(10000);
}

} // namespace benchmarks
