/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "multiview/verdicts.h"

#include "multiview/pair_choice.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <sstream>

namespace pcl {
namespace kss {
namespace {

/** The triangles of pairs whose poses lead back to where they began. */
std::size_t
trianglesOf(const GraphPair& pair,
            const std::map<ScanPair, Eigen::Matrix4d>& kept,
            const PlacedScans& placed)
{
  const std::size_t a = pair.result.source, b = pair.result.target;
  const auto poseOf = [&](std::size_t source,
                          std::size_t target) -> std::optional<Eigen::Matrix4d> {
    const auto found = kept.find({std::min(source, target), std::max(source, target)});
    if (found == kept.end())
      return {};
    return source < target ? found->second : inverted(found->second);
  };
  const StoredPose& own = pair.result.poses[pair.pose].transformation;
  std::size_t triangles = 0;
  for (std::size_t c = 0; c < placed.descriptions.size(); ++c) {
    if (c == a || c == b)
      continue;
    const auto to_c = poseOf(a, c), from_c = poseOf(c, b);
    if (to_c && from_c &&
        displacement(placed.descriptions[a], *from_c * *to_c, own) <=
            agreeing_share * placed.smallerRadius(a, b))
      ++triangles;
  }
  return triangles;
}

/** What a pair is to the model. */
GraphPair
judged(const PairResult& pair,
       const std::vector<std::size_t>& group_of,
       const PlacedScans& placed)
{
  GraphPair graph;
  graph.result = pair;
  const bool is_accepted = pair.failure.cause == FailureCause::NONE;
  // what says nothing of the scans; those of very different sizes are refused
  const std::set<FailureCause> troubles = {FailureCause::DEVICE, FailureCause::STOPPED,
                                           FailureCause::OTHER};
  graph.verdict = is_accepted                              ? PairVerdict::REJECTED
                  : troubles.count(pair.failure.cause) > 0 ? PairVerdict::FAILED
                                                           : PairVerdict::REFUSED;
  graph.reason = pair.failure.reason;
  if (pair.poses.empty())
    return graph;
  if (group_of[pair.source] != group_of[pair.target]) {
    if (is_accepted)
      graph.reason = "No other pair confirms it, and by itself it is not sure enough "
                     "among so many pairs.";
    return graph;
  }
  if (placed.isKept(pair)) {
    const auto [pose, deviation] = placed.nearestPose(pair);
    graph.pose = pose;
    graph.deviation = deviation;
    graph.verdict = PairVerdict::KEPT;
    graph.reason.clear();
    return graph;
  }
  graph.deviation =
      placed.deviationOf(pair.source, pair.target, pair.poses.front().transformation);
  if (is_accepted) {
    std::ostringstream reason;
    reason << "Other pairs place the source " << graph.deviation
           << " from there, root mean square.";
    graph.reason = reason.str();
  }
  return graph;
}

} // namespace

std::vector<GraphPair>
verdictsOn(const std::vector<PairResult>& pairs, const PlacedScans& placed)
{
  const std::vector<std::size_t> group_of =
      groupOfEach(placed.groups, placed.descriptions.size());
  std::vector<GraphPair> verdicts;
  std::map<ScanPair, Eigen::Matrix4d> kept;
  for (const PairResult& pair : pairs) {
    verdicts.push_back(judged(pair, group_of, placed));
    const GraphPair& graph = verdicts.back();
    if (graph.verdict == PairVerdict::KEPT)
      kept[{pair.source, pair.target}] = pair.poses[graph.pose].transformation;
  }
  for (GraphPair& pair : verdicts)
    if (!pair.result.poses.empty())
      pair.loops = trianglesOf(pair, kept, placed);
  return verdicts;
}

} // namespace kss
} // namespace pcl
