/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "multiview/placing.h"

#include "multiview/candidates_of_pairs.h"
#include "multiview/pair_choice.h"
#include "multiview/pose_graph.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace pcl {
namespace kss {
namespace {

/** Each scan fits so many others, about; and of the pairs that confidences were fitted
 * on, three fit for two that do not: the logarithm of that. */
constexpr double partners_that_fit = 4.0, usual_log_odds = 0.4;

/** So many pairs that are as sure as they say are assumed beside those that there are;
 * and less than this changes nothing. */
constexpr double few = 3.0, least_shift = 0.2;

/** Loops cope with wrong pairs as long as so much of those that are sure agrees; of
 * rooms that fit on each other less does, one upon the other though they lie. */
constexpr double least_agreeing = 0.45;

/** The error of a pair's pose as a share of the scan's radius, where nothing better is
 * known: degrees, not tens of them. */
constexpr double usual_error = 0.02;

/** So many rounds of believing pairs less. */
constexpr int most_rounds = 4;

/** Confidences were fitted on pairs most of which fit. Of many scans each fits a few
 * others: the more pairs there are for each, the fewer of them are right. */
double
baseShift(const std::vector<PairResult>& pairs, std::size_t usable)
{
  double tried = 0.0;
  for (const PairResult& pair : pairs)
    tried += pair.poses.empty() || pair.of_groups ? 0.0 : 1.0;
  const double right = partners_that_fit / 2.0 * static_cast<double>(usable);
  const double others = tried - right;
  return others <= 0.0 ? 0.0 : std::min(0.0, std::log(right / others) - usual_log_odds);
}

/** By how much the odds of pairs have to change, as a logarithm, for as many of those
 * that are accepted to agree with where the scans are as say so; 0 where most do. */
double
shiftOfAgreement(const std::vector<PairResult>& pairs, const PlacedScans& placed)
{
  const std::vector<std::size_t> group_of =
      groupOfEach(placed.groups, placed.descriptions.size());
  double accepted = 0.0, expected = 0.0, agreeing = 0.0;
  for (const PairResult& pair : pairs) {
    if (pair.failure.cause != FailureCause::NONE || pair.poses.empty())
      continue;
    accepted += 1.0;
    expected += std::min(pair.confidence, surest);
    if (group_of[pair.source] == group_of[pair.target] && placed.isKept(pair))
      agreeing += 1.0;
  }
  if (accepted == 0.0)
    return 0.0;
  // a few that are as expected: one or two pairs prove nothing
  const double usual = expected / accepted;
  const double share = (agreeing + few * usual) / (accepted + few);
  return share < least_agreeing ? logOdds(share) - logOdds(usual) : 0.0;
}

/** What the pairs of a group say, those that agree with the rest. */
std::vector<PoseLink>
linksOf(const PlacedGroup& group,
        const std::vector<PoseCandidate>& candidates,
        const PlacedScans& placed)
{
  const std::set<std::size_t> members(group.begin(), group.end());
  std::vector<PoseLink> links;
  for (const PoseCandidate& candidate : candidates) {
    const auto [source, target] = std::pair(candidate.source, candidate.target);
    if (!members.count(source) || !members.count(target))
      continue;
    const double radius = placed.smallerRadius(source, target);
    if (placed.deviationOf(source, target, candidate.transformation) >
        2.0 * agreeing_share * radius)
      continue;
    PoseLink link;
    link.source = source;
    link.target = target;
    link.transformation = candidate.transformation;
    link.information = informationOfDisplacement(placed.descriptions[source],
                                                 candidate.transformation) /
                       std::pow(usual_error * radius, 2);
    links.push_back(link);
  }
  return links;
}

} // namespace

void
placeByPairs(const std::vector<PairResult>& pairs,
             std::size_t usable,
             PlacedScans& placed)
{
  const double base = baseShift(pairs, usable);
  double shift = base;
  for (int round = 0; round < most_rounds; ++round) {
    const std::vector<PoseCandidate> candidates = candidatesOf(pairs, shift);
    Consensus consensus = consensusOf(placed.descriptions, candidates);
    placed.poses = std::move(consensus.poses);
    placed.groups = std::move(consensus.groups);
    for (const PlacedGroup& group : placed.groups)
      solvePoses(placed.descriptions, group, linksOf(group, candidates, placed),
                 placed.poses);
    const double shown = base + shiftOfAgreement(pairs, placed);
    if (shown > shift - least_shift)
      return;
    shift = shown;
  }
}

} // namespace kss
} // namespace pcl
