/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

// A second source for the same target: by the object that has registered the first one,
// and by a new object.

#include "judgement.h"
#include "registration.h"
#include "sizes.h"

namespace benchmarks {
namespace {

void
SecondSource(benchmark::State& state)
{
  const Pair& first = pairOf(state.range(0));
  const Pair& second = secondPairOf(state.range(0));
  KSSICP kss_icp;
  kss_icp.setInputSource(first.source);
  kss_icp.setInputTarget(first.target);
  Cloud aligned;
  kss_icp.align(aligned);
  for (auto _ : state) {
    kss_icp.setInputSource(second.source);
    kss_icp.align(aligned);
  }
  judge(state, kss_icp.getFinalTransformation(), second);
}
BENCHMARK(SecondSource)->Apply(someSizes);

void
SecondSourceFreshObject(benchmark::State& state)
{
  warmUp();
  const Pair& second = secondPairOf(state.range(0));
  Eigen::Matrix4f pose = Eigen::Matrix4f::Identity();
  for (auto _ : state) {
    KSSICP kss_icp;
    kss_icp.setInputSource(second.source);
    kss_icp.setInputTarget(second.target);
    Cloud aligned;
    kss_icp.align(aligned);
    pose = kss_icp.getFinalTransformation();
  }
  judge(state, pose, second);
}
BENCHMARK(SecondSourceFreshObject)->Apply(someSizes);

} // namespace
} // namespace benchmarks
