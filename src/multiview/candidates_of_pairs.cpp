/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "multiview/candidates_of_pairs.h"

#include <algorithm>
#include <cmath>

namespace pcl {
namespace kss {
namespace {

/** What is less probable is not worth a look. */
constexpr double least_probable = 0.03;

} // namespace

std::vector<PoseCandidate>
candidatesOf(const std::vector<PairResult>& pairs, const std::vector<double>& shifts)
{
  std::vector<PoseCandidate> candidates;
  for (std::size_t p = 0; p < pairs.size(); ++p) {
    const PairResult& pair = pairs[p];
    if (pair.poses.empty())
      continue;
    // the pair's confidence is that one of the best poses is right
    const double best = pair.poses.front().log_odds;
    double sum = 0.0;
    for (const PairPose& pose : pair.poses)
      sum += std::exp(std::min(pose.log_odds - best, 0.0));
    for (std::size_t i = 0; i < pair.poses.size(); ++i) {
      const double share = std::exp(std::min(pair.poses[i].log_odds - best, 0.0)) / sum;
      const double alone = std::min(surest, pair.confidence * share);
      const double shift = shifts.empty() ? 0.0 : shifts[p];
      const double odds = std::exp(shift) * alone / (1.0 - alone);
      const double probability = odds / (1.0 + odds);
      if (probability >= least_probable)
        candidates.push_back({p, i, pair.source, pair.target,
                              pair.poses[i].transformation, probability});
    }
  }
  return candidates;
}

double
logOdds(double probability)
{
  return std::log(probability / (1.0 - probability));
}

} // namespace kss
} // namespace pcl
