/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

// How fast the inner loops of the search are, and how fast the processor is: items per
// second of CPU time.

#include "process.h"

#include "evaluators/evaluator_choice.h"
#include "search/screening.h"

#include <benchmark/benchmark.h>

#include <numeric>
#include <random>

namespace benchmarks {
namespace {

using namespace pcl::kss;

constexpr int points = 2000;

/** \brief Points of a ball's surface. */
Points
sphere(unsigned int seed)
{
  std::mt19937 random(seed);
  std::normal_distribution<float> normal;
  Points cloud(3, points);
  for (int i = 0; i < points; ++i)
    cloud.col(i) =
        Eigen::Vector3f(normal(random), normal(random), normal(random)).normalized();
  return cloud;
}

/** \brief So many rotations with centres around the origin. */
std::vector<Placement>
somePlacements(int number)
{
  std::mt19937 random(3);
  std::normal_distribution<float> normal;
  std::vector<Placement> placements(number);
  for (Placement& placement : placements) {
    const Eigen::Quaternionf turn(normal(random), normal(random), normal(random),
                                  normal(random));
    placement.leftCols<3>() = turn.normalized().toRotationMatrix();
    placement.col(3) =
        0.3f * Eigen::Vector3f(normal(random), normal(random), normal(random));
  }
  return placements;
}

void
countItems(benchmark::State& state, double items)
{
  state.SetItemsProcessed(
      static_cast<std::int64_t>(items * static_cast<double>(state.iterations())));
}

/** \brief Pairs of points, both directions at once: kernels/pair_distances.cl. */
void
PairDistances(benchmark::State& state)
{
  const auto evaluator = makePairDistances(Settings());
  evaluator->setClouds(sphere(1), sphere(2));
  const auto placements = somePlacements(500);
  evaluator->evaluate(placements);
  for (auto _ : state)
    benchmark::DoNotOptimize(evaluator->evaluate(placements));
  countItems(state, 500.0 * points * points);
}
BENCHMARK(PairDistances)->MeasureProcessCPUTime()->Unit(benchmark::kMillisecond);

/** \brief Single look-ups in distance fields: kernels/look_ups.cl. */
void
LookUps(benchmark::State& state)
{
  Settings settings;
  const auto evaluator = makeLookUps(settings);
  evaluator->setClouds(sphere(1), sphere(2), 0.35f);
  const auto placements = somePlacements(50000);
  evaluator->evaluate(placements);
  for (auto _ : state)
    benchmark::DoNotOptimize(evaluator->evaluate(placements));
  countItems(state, 2.0 * 50000 * settings.search_points);
}
BENCHMARK(LookUps)->MeasureProcessCPUTime()->Unit(benchmark::kMillisecond);

/** \brief Look-ups of lower and upper bounds: kernels/bounds.cl. */
void
BoundLookUps(benchmark::State& state)
{
  const auto bounds = makeBounds(Settings());
  BoundsScope scope;
  scope.largest_shift = 2.0;
  bounds->setClouds(sphere(1), sphere(2), scope);
  const auto placements = somePlacements(2000);
  bounds->evaluate(placements, points);
  for (auto _ : state)
    benchmark::DoNotOptimize(bounds->evaluate(placements, points));
  countItems(state, 2.0 * 2000 * points);
}
BENCHMARK(BoundLookUps)->MeasureProcessCPUTime()->Unit(benchmark::kMillisecond);

/** \brief Look-ups for all centres of a grid at once, kernels/shift_sums.cl, and what
 * it takes to pick the lowest of them. */
void
ScreeningLookUps(benchmark::State& state)
{
  Settings settings;
  Screening screening(settings);
  Points target = sphere(2);
  target.row(0) *= 1.6f;
  screening.setClouds(sphere(1), target, 0.35f);
  const std::shared_ptr<const CandidateRotations> rotations =
      candidateRotations(settings);
  const Candidates candidates(rotations, {1.0}, spreadCenters(target, 1.6, 0.3),
                              Role::TARGET);
  screening.lowest(candidates, 8000);
  for (auto _ : state)
    benchmark::DoNotOptimize(screening.lowest(candidates, 8000));
  countItems(state, static_cast<double>(candidates.size()) * settings.search_points);
}
BENCHMARK(ScreeningLookUps)->MeasureProcessCPUTime()->Unit(benchmark::kMillisecond);

// What the processor can do at most.

#if defined(__GNUC__) && defined(__x86_64__)
using Vector = float __attribute__((vector_size(32)));

/** \brief Multiplications with addition, eight to an instruction, ten at once. */
__attribute__((target("avx2,fma"), optimize("fp-contract=fast"))) float
multiplyAdd(int times)
{
  Vector sums[10] = {};
  Vector a = Vector{} + 0.999f, b = Vector{} + 0.001f;
  for (int i = 0; i < times; ++i) {
    asm volatile("" : "+x"(a), "+x"(b));
    for (Vector& sum : sums)
      sum = sum * a + b;
  }
  Vector all = {};
  for (const Vector& sum : sums)
    all += sum;
  return all[0];
}

void
PeakMultiplyAdds(benchmark::State& state)
{
  constexpr int times = 1000000;
  for (auto _ : state)
    benchmark::DoNotOptimize(multiplyAdd(times));
  countItems(state, 80.0 * times);
}
BENCHMARK(PeakMultiplyAdds)->MeasureProcessCPUTime()->Unit(benchmark::kMillisecond);

/** \brief Bytes read, 32 to an instruction. */
__attribute__((target("avx2"))) float
readAll(const std::vector<Vector>& values, int times)
{
  Vector a = {}, b = {}, c = {}, d = {};
  for (int t = 0; t < times; ++t) {
    for (std::size_t i = 0; i < values.size(); i += 4) {
      a += values[i];
      b += values[i + 1];
      c += values[i + 2];
      d += values[i + 3];
    }
    asm volatile("" ::: "memory");
  }
  return (a + b + c + d)[0];
}

/** \brief Of a field of so many kilobytes. */
void
PeakBytesRead(benchmark::State& state)
{
  const std::vector<Vector> values(state.range(0) * 1024 / sizeof(Vector));
  constexpr int times = 1000;
  for (auto _ : state)
    benchmark::DoNotOptimize(readAll(values, times));
  countItems(state, 1024.0 * times * static_cast<double>(state.range(0)));
}
BENCHMARK(PeakBytesRead)
    ->Arg(16)
    ->Arg(256)
    ->Arg(4096)
    ->MeasureProcessCPUTime()
    ->Unit(benchmark::kMillisecond);
#endif

} // namespace
} // namespace benchmarks
