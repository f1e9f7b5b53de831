/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

// What PCL offers for the same task: SAC-IA on features, then ICP.

#include "judgement.h"
#include "sac_ia_icp.h"
#include "sizes.h"

#include <cstdint>
#include <map>
#include <tuple>

namespace benchmarks {
namespace {

void
registerPair(benchmark::State& state, const Effort& effort)
{
  // every repetition draws other samples, and all of them have to solve the pair
  static std::map<std::tuple<int, int, std::int64_t>, unsigned int> seeds;
  unsigned int& seed = seeds[{effort.samplings, effort.icp_iterations, state.range(0)}];
  const Pair& pair = pairOf(state.range(0));
  SacIaResult result{};
  for (auto _ : state)
    result = registerBySacIa(pair, effort, ++seed);

  state.counters["voxel_grid_s"] = result.voxel_grid;
  state.counters["normals_s"] = result.normals;
  state.counters["features_s"] = result.features;
  state.counters["sac_ia_s"] = result.sac_ia;
  state.counters["icp_s"] = result.icp;
  state.counters["icp_iterations"] = result.icp_iterations;
  judge(state, result.pose, pair);
}

// About the least number of samplings that can be relied upon for these clouds. ICP
// goes on until it rests by the criterion of KSSICP's own final ICP, but 50 iterations
// at most.
void
SacIaIcp(benchmark::State& state)
{
  registerPair(state, {100, 2, 50, 1e-5});
}
BENCHMARK(SacIaIcp)->Apply(smallSizes);
BENCHMARK(SacIaIcp)->Apply(largeSizes);

// The same with as little ICP as PCL does by default: ten iterations. It solves the
// pair, too, but less exactly: compare error_degrees.
void
SacIaShortIcp(benchmark::State& state)
{
  registerPair(state, {100, 2, 10, 0.0});
}
BENCHMARK(SacIaShortIcp)->Apply(smallSizes);
BENCHMARK(SacIaShortIcp)->Apply(largeSizes);

// SAC-IA as PCL's tutorial on aligning object templates runs it, for pairs that nobody
// tried before: 500 samplings, the randomness that is PCL's default.
void
SacIaOfTutorialIcp(benchmark::State& state)
{
  registerPair(state, {500, 10, 50, 1e-5});
}
BENCHMARK(SacIaOfTutorialIcp)->Apply(smallSizes);

} // namespace
} // namespace benchmarks
