/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "multiview/consensus.h"

#include "multiview/placement_of_scans.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <utility>

namespace pcl {
namespace kss {
namespace {

// evaluation/fit_many_scans.py fits these: 0.01, and 0.1 and 0.5, are likeliest. They
// are more careful here, as the sets have little that is alike from several sides, such
// as furniture.

/** How often a wrong pose agrees with a right one, by chance: wrong poses are not
 * random, as rooms and objects have planes and axes. */
constexpr double chance = 0.05;

/** Pairs of what is built alike, such as the sides of a square, are wrong in the same
 * way, all of them: they agree, but are unsure. Those less probable than the first say
 * nothing to each other, those more probable than the second all that they have to. */
constexpr double unsure = 0.3, sure = 0.6;

/** A way by a third group goes by so many candidates to it, and from it. */
constexpr std::size_t most_of_detours = 4;

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
         const std::vector<PoseCandidate>& candidates)
  : scans_(scans)
  , candidates_(candidates)
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
      noteLikeliest(groups);
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

  /** How much more probable an alignment is for a pair, or a way by a third group, that
   * agrees with it: the ratio of what is to be expected of one to chance. */
  static double
  gain(double agreeing)
  {
    const double say = std::clamp((agreeing - unsure) / (sure - unsure), 0.0, 1.0);
    return say * std::log((agreeing + (1.0 - agreeing) * chance) / chance);
  }

  /** The most probable alignment of two groups. Its odds are against all others, be it
   * that one or none of those is right. */
  GroupAlignment
  bestAlignment(const GroupPair& groups, const std::vector<std::size_t>& those) const
  {
    const std::vector<Detour> detours = detoursBetween(groups);
    std::vector<GroupAlignment> alignments;
    for (const std::size_t own : those) {
      GroupAlignment alignment;
      alignment.transformation = alignmentBy(candidates_[own], groups);
      alignment.odds = logOdds(candidates_[own].probability);
      std::map<std::size_t, double> others; // pairs that agree
      for (const std::size_t other : those)
        if (const PoseCandidate& candidate = candidates_[other];
            candidate.pair != candidates_[own].pair &&
            agrees(candidate, groups, alignment.transformation))
          others[candidate.pair] += candidate.probability;
      for (const auto& [pair, agreeing] : others)
        alignment.odds += gain(agreeing);
      std::map<std::size_t, double> thirds; // groups
      for (const Detour& detour : detours)
        if (agrees(detour, alignment.transformation))
          thirds[detour.third] = std::max(thirds[detour.third], detour.probability);
      for (const auto& [third, agreeing] : thirds)
        alignment.odds += gain(agreeing);
      alignments.push_back(alignment);
    }
    const auto best =
        std::max_element(alignments.begin(), alignments.end(),
                         [](const auto& a, const auto& b) { return a.odds < b.odds; });
    GroupAlignment result = *best;
    double rival = -std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < those.size(); ++i)
      if (!agrees(candidates_[those[i]], groups, best->transformation))
        rival = std::max(rival, alignments[i].odds);
    for (const Detour& detour : detours)
      if (!agrees(detour, best->transformation))
        rival = std::max(rival, logOdds(detour.probability));
    result.odds -= std::log1p(std::exp(rival));
    return result;
  }

  /** A way from the second of two groups to the first by a third one. */
  struct Detour {
    std::size_t third = 0;
    std::size_t scan = 0; ///< of the second group, which stands for what is placed
    double probability = 0.0;
    Eigen::Matrix4d transformation = Eigen::Matrix4d::Identity();
  };

  std::vector<Detour>
  detoursBetween(const GroupPair& groups) const
  {
    std::vector<Detour> detours;
    for (const std::size_t third : neighbours_.at(groups.first)) {
      if (third == groups.second || !neighbours_.at(groups.second).count(third))
        continue;
      const GroupPair one = ordered(groups.first, third);
      const GroupPair other = ordered(groups.second, third);
      for (const std::size_t a : likeliest_.at(one))
        for (const std::size_t b : likeliest_.at(other)) {
          Detour detour;
          detour.third = third;
          detour.scan = group_of_[candidates_[b].source] == groups.second
                            ? candidates_[b].source
                            : candidates_[b].target;
          detour.probability =
              std::min(candidates_[a].probability, candidates_[b].probability);
          detour.transformation =
              oriented(alignmentBy(candidates_[a], one), one.first == groups.first) *
              oriented(alignmentBy(candidates_[b], other), other.first == third);
          detours.push_back(detour);
        }
    }
    return detours;
  }

  /** Whether a detour leads to where an alignment does, more or less: its error is that
   * of two. */
  bool
  agrees(const Detour& detour, const Eigen::Matrix4d& T_first_second) const
  {
    const Eigen::Matrix4d pose = poses_[detour.scan];
    return displacement(scans_[detour.scan], T_first_second * pose,
                        detour.transformation * pose) <=
           2.0 * agreeing_share * radiusOf(scans_[detour.scan]);
  }

  /** An alignment of two groups, or the inverse. */
  static Eigen::Matrix4d
  oriented(const Eigen::Matrix4d& alignment, bool is_so)
  {
    return is_so ? alignment : inverted(alignment);
  }

  /** Note what of the candidates between two groups ways by a third one go by. */
  void
  noteLikeliest(const GroupPair& groups)
  {
    std::vector<std::size_t> those = between_.at(groups);
    std::stable_sort(those.begin(), those.end(), [&](std::size_t a, std::size_t b) {
      return candidates_[a].probability > candidates_[b].probability;
    });
    those.resize(std::min(those.size(), most_of_detours));
    likeliest_[groups] = those;
    neighbours_[groups.first].insert(groups.second);
    neighbours_[groups.second].insert(groups.first);
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
      likeliest_.erase(entry->first);
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
    for (const std::size_t third : neighbours_[second])
      neighbours_[third].erase(second);
    neighbours_.erase(second);
    neighbours_[first].erase(second);
    for (const GroupPair& pair : changed)
      noteLikeliest(pair);
    for (const GroupPair& pair : changed)
      alignments_[pair] = bestAlignment(pair, between_[pair]);
  }

  const std::vector<ScanDescription>& scans_;
  const std::vector<PoseCandidate>& candidates_;
  std::vector<std::size_t> group_of_;
  std::vector<PlacedGroup> groups_;
  std::vector<StoredPose> poses_;
  std::map<GroupPair, std::vector<std::size_t>> between_;   ///< candidates
  std::map<GroupPair, std::vector<std::size_t>> likeliest_; ///< of these
  std::map<std::size_t, std::set<std::size_t>> neighbours_; ///< groups with candidates
  std::map<GroupPair, GroupAlignment> alignments_;
};

} // namespace

Consensus
consensusOf(const std::vector<ScanDescription>& scans,
            const std::vector<PoseCandidate>& candidates)
{
  Uniter uniter(scans, candidates);
  uniter.run();
  return uniter.consensus();
}

} // namespace kss
} // namespace pcl
