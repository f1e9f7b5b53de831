/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

// The whole registration by KSSICP of two scans, whose scale is known: each seed is
// another street or room.

#include "registration.h"
#include "scans.h"
#include "sizes.h"

namespace benchmarks {
namespace {

void
registerScans(benchmark::State& state, const Pair& pair)
{
  pcl::kss::Settings settings = KSSICP().getSettings();
  settings.estimate_scale = false;
  state.counters["source_points"] = static_cast<double>(pair.source->size());
  state.counters["target_points"] = static_cast<double>(pair.target->size());
  registerPair(state, pair, settings);
}

void
StreetRigid(benchmark::State& state)
{
  registerScans(state, streetPair(state.range(0)));
}
BENCHMARK(StreetRigid)->Apply(allSeeds);

void
RoomRigid(benchmark::State& state)
{
  registerScans(state, roomPair(state.range(0)));
}
BENCHMARK(RoomRigid)->Apply(allSeeds);

} // namespace
} // namespace benchmarks
