/*
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * What distances are compared with: the definition, and themselves.
 */

#pragma once

#include "poses.h"

#include "evaluators/distance_evaluator.h"

#include <algorithm>
#include <limits>
#include <random>
#include <vector>

namespace kss_test {

/** \brief Between two clouds, one way. */
struct Distances {
  double farthest = 0.0, mean = 0.0;
};

/** \brief From every point of one cloud to the other, by the definition. */
inline Distances
directed(const Eigen::Matrix3Xd& from, const Eigen::Matrix3Xd& to, double limit)
{
  Distances distances;
  for (Eigen::Index i = 0; i < from.cols(); ++i) {
    double nearest = std::numeric_limits<double>::max();
    for (Eigen::Index j = 0; j < to.cols(); ++j)
      nearest = std::min(nearest, (from.col(i) - to.col(j)).norm());
    distances.farthest = std::max(distances.farthest, nearest);
    distances.mean += std::min(nearest, limit) / from.cols();
  }
  return distances;
}

/** \brief Any rotation, a scale in [0.5, 2], a small shift. */
inline std::vector<pcl::kss::Placement>
randomPlacements(std::size_t number, unsigned int seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> scale(0.5, 2.0);
  std::vector<pcl::kss::Placement> placements;
  for (std::size_t i = 0; i < number; ++i) {
    // one after the other: a compiler evaluates arguments in any order
    const auto shift = randomVector(random, 0.3);
    const double factor = scale(random);
    const auto rotation = randomRotation(random);
    placements.push_back(
        similarity(rotation, factor, shift).topRows<3>().cast<float>());
  }
  return placements;
}

inline bool
sameBits(const std::vector<pcl::kss::DirectedDistances>& a,
         const std::vector<pcl::kss::DirectedDistances>& b)
{
  if (a.size() != b.size())
    return false;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (a[i].source_to_target != b[i].source_to_target ||
        a[i].target_to_source != b[i].target_to_source ||
        a[i].mean_source_to_target != b[i].mean_source_to_target ||
        a[i].mean_target_to_source != b[i].mean_target_to_source)
      return false;
  return true;
}

} // namespace kss_test
