/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "clouds.h"

#include <benchmark/benchmark.h>

/** Whether a registration found the pose: only then does its time count. */
namespace benchmarks {

/** \brief How far a pose is from the truth. */
struct Deviation {
  double degrees; ///< between the rotations
  double percent; ///< between the centres of the aligned sources, of the diagonal
};

/** \brief Compare a similarity that maps the source to the target with the truth. */
Deviation
deviationOf(const Eigen::Matrix4f& pose, const Pair& pair);

/** \brief Less than 5 degrees and 5 % of the diagonal off. */
bool
isSolved(const Deviation& deviation);

/** \brief Report the deviation as counters, and an error where the pair is not solved.
 */
void
judge(benchmark::State& state, const Eigen::Matrix4f& pose, const Pair& pair);

} // namespace benchmarks
