/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "multiview/consensus.h"

#include "multiview/placement_of_scans.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <utility>

namespace pcl {
namespace kss {
namespace {

/** How often a wrong pose agrees with a right one, by chance: wrong poses are not
 * random, as rooms and objects have planes and axes. */
constexpr double chance = 0.02;

/** Two groups, the lower number first. */
using GroupPair = std::pair<std::size_t, std::size_t>;

/** An alignment of two groups. */
struct GroupAlignment {
  double odds = 0.0; ///< the logarithm of them
  Eigen::Matrix4d transformation = Eigen::Matrix4d::Identity(); ///< second to first
};

class Uniter {
public:
  Uniter(const std::vector<ScanDescription>& scans,
         const std::vector<PoseCandidate>& candidates,
         double prior)
  : scans_(scans)
  , candidates_(candidates)
  , prior_(prior)
  , group_of_(scans.size())
  , groups_(scans.size())
  , poses_(scans.size(), StoredPose::Identity())
  {
    std::iota(group_of_.begin(), group_of_.end(), 0);
    for (std::size_t i = 0; i < scans.size(); ++i)
      groups_[i] = {i};
    for (std::size_t c = 0; c < candidates.size(); ++c)
      between_[ordered(candidates[c].source, candidates[c].target)].push_back(c);
    for (const auto& [groups, those] : between_)
      alignments_[groups] = bestAlignment(groups, those);
  }

  /** Unite groups for as long as it is more probable than not that they lie so. */
  void
  run()
  {
    while (!alignments_.empty()) {
      const auto best = std::max_element(
          alignments_.begin(), alignments_.end(),
          [](const auto& a, const auto& b) { return a.second.odds < b.second.odds; });
      if (best->second.odds <= 0.0)
        return;
      const auto [groups, alignment] = *best;
      unite(groups, alignment.transformation);
    }
  }

  Consensus
  consensus() const
  {
    Consensus result;
    result.poses = poses_;
    for (const PlacedGroup& group : groups_)
      if (!group.empty())
        result.groups.push_back(group);
    return result;
  }

private:
  static GroupPair
  ordered(std::size_t a, std::size_t b)
  {
    return {std::min(a, b), std::max(a, b)};
  }

  /** What a candidate makes of the frames of two groups: second to first. */
  Eigen::Matrix4d
  alignmentBy(const PoseCandidate& candidate, const GroupPair& groups) const
  {
    const Eigen::Matrix4d T_target_source = Eigen::Matrix4d(poses_[candidate.target]) *
                                            Eigen::Matrix4d(candidate.transformation) *
                                            inverted(poses_[candidate.source]);
    return group_of_[candidate.source] == groups.second ? T_target_source
                                                        : inverted(T_target_source);
  }

  /** Whether a candidate places its source where an alignment does, about. */
  bool
  agrees(const PoseCandidate& candidate,
         const GroupPair& groups,
         const Eigen::Matrix4d& alignment) const
  {
    const Eigen::Matrix4d T_target_source =
        inverted(poses_[candidate.target]) *
        (group_of_[candidate.source] == groups.second ? alignment
                                                      : inverted(alignment)) *
        Eigen::Matrix4d(poses_[candidate.source]);
    const double reach = agreeing_share * std::min(radiusOf(scans_[candidate.source]),
                                                   radiusOf(scans_[candidate.target]));
    return displacement(scans_[candidate.source], T_target_source,
                        candidate.transformation) <= reach;
  }

  /** How much more probable an alignment is for what a pair says of it: the likelihood
   * ratio of that to what it would say were the alignment wrong. */
  static double
  gain(double agreeing, double disagreeing)
  {
    return agreeing > 0.0 ? std::log((agreeing + (1.0 - agreeing) * chance) / chance)
                          : std::log(1.0 - disagreeing);
  }

  GroupAlignment
  bestAlignment(const GroupPair& groups, const std::vector<std::size_t>& those) const
  {
    GroupAlignment best;
    best.odds = -1.0;
    for (const std::size_t own : those) {
      GroupAlignment alignment;
      alignment.transformation = alignmentBy(candidates_[own], groups);
      alignment.odds = logOdds(candidates_[own].probability) + prior_;
      // of each other pair, what speaks for it and against it
      std::map<std::size_t, std::pair<double, double>> others;
      for (const std::size_t other : those) {
        const PoseCandidate& candidate = candidates_[other];
        if (candidate.pair == candidates_[own].pair)
          continue;
        auto& [agreeing, disagreeing] = others[candidate.pair];
        (agrees(candidate, groups, alignment.transformation) ? agreeing
                                                             : disagreeing) +=
            candidate.probability;
      }
      for (const auto& [pair, said] : others)
        alignment.odds += gain(said.first, said.second);
      if (alignment.odds > best.odds)
        best = alignment;
    }
    return best;
  }

  void
  unite(const GroupPair& groups, const Eigen::Matrix4d& T_first_second)
  {
    const auto [first, second] = groups;
    for (const std::size_t scan : groups_[second]) {
      poses_[scan] = T_first_second * Eigen::Matrix4d(poses_[scan]);
      group_of_[scan] = first;
    }
    PlacedGroup united;
    std::merge(groups_[first].begin(), groups_[first].end(), groups_[second].begin(),
               groups_[second].end(), std::back_inserter(united));
    groups_[first] = std::move(united);
    groups_[second].clear();

    // what was between one of them and a third is between both and that
    std::set<GroupPair> changed;
    for (auto entry = between_.begin(); entry != between_.end();) {
      const auto [a, b] = entry->first;
      if (a != first && b != first && a != second && b != second) {
        ++entry;
        continue;
      }
      alignments_.erase(entry->first);
      if (entry->first == groups) {
        entry = between_.erase(entry);
        continue;
      }
      const std::size_t third = a == first || a == second ? b : a;
      changed.insert(ordered(first, third));
      if (a == second || b == second) {
        std::vector<std::size_t> moved = std::move(entry->second);
        entry = between_.erase(entry);
        std::vector<std::size_t>& those = between_[ordered(first, third)];
        those.insert(those.end(), moved.begin(), moved.end());
        std::sort(those.begin(), those.end());
      }
      else
        ++entry;
    }
    for (const GroupPair& pair : changed)
      alignments_[pair] = bestAlignment(pair, between_[pair]);
  }

  const std::vector<ScanDescription>& scans_;
  const std::vector<PoseCandidate>& candidates_;
  double prior_;
  std::vector<std::size_t> group_of_;
  std::vector<PlacedGroup> groups_;
  std::vector<StoredPose> poses_;
  std::map<GroupPair, std::vector<std::size_t>> between_; ///< candidates
  std::map<GroupPair, GroupAlignment> alignments_;
};

/** The logarithm of the odds that a pair of scans that has been tried is a right one,
 * where each scan needs one about; not above even, which confidences go by. Half of it:
 * they were fitted on clouds of which many do not fit, too. */
double
priorOf(std::size_t scans, std::size_t pairs)
{
  const double needed = static_cast<double>(std::max<std::size_t>(scans, 2) - 1);
  const double others = static_cast<double>(pairs) - needed;
  return others <= needed ? 0.0 : 0.5 * std::log(needed / others);
}

} // namespace

Consensus
consensusOf(const std::vector<ScanDescription>& scans,
            const std::vector<PoseCandidate>& candidates,
            std::size_t pairs_tried)
{
  Uniter uniter(scans, candidates, priorOf(scans.size(), pairs_tried));
  uniter.run();
  return uniter.consensus();
}

} // namespace kss
} // namespace pcl
