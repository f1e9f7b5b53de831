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

/** Each scan fits so many others, about, as evaluation/fit_many_scans.py fits it; and
 * of the pairs that confidences were fitted on, three fit for two that do not: the
 * logarithm of that. */
constexpr double partners_that_fit = 5.0, usual_log_odds = 0.4;

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

/** Of each scan: by how much the odds of its pairs have to change, as a logarithm, for
 * as many of those that are accepted to agree with where the scans are as say so; 0
 * where most do. */
std::vector<double>
shiftsOfAgreement(const std::vector<PairResult>& pairs, const PlacedScans& placed)
{
  const std::size_t scans = placed.descriptions.size();
  const std::vector<std::size_t> group_of = groupOfEach(placed.groups, scans);
  std::vector<double> accepted(scans), expected(scans), agreeing(scans), shifts(scans);
  for (const PairResult& pair : pairs) {
    if (pair.failure.cause != FailureCause::NONE || pair.poses.empty())
      continue;
    const bool agrees =
        group_of[pair.source] == group_of[pair.target] && placed.isKept(pair);
    for (const std::size_t scan : {pair.source, pair.target}) {
      accepted[scan] += 1.0;
      expected[scan] += std::min(pair.confidence, surest);
      agreeing[scan] += agrees ? 1.0 : 0.0;
    }
  }
  for (std::size_t scan = 0; scan < scans; ++scan) {
    if (accepted[scan] == 0.0)
      continue;
    // a few that are as expected: one or two pairs prove nothing
    const double usual = expected[scan] / accepted[scan];
    const double share = (agreeing[scan] + few * usual) / (accepted[scan] + few);
    if (share < least_agreeing)
      shifts[scan] = logOdds(share) - logOdds(usual);
  }
  return shifts;
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

double
shiftOfMany(std::size_t pairs, std::size_t scans)
{
  const double right = partners_that_fit / 2.0 * static_cast<double>(scans);
  const double others = static_cast<double>(pairs) - right;
  return others <= 0.0 ? 0.0 : std::min(0.0, std::log(right / others) - usual_log_odds);
}

void
placeByPairs(const std::vector<PairResult>& pairs,
             const std::vector<double>& shifts,
             PlacedScans& placed)
{
  std::vector<double> shifts_of_scans(placed.descriptions.size());
  for (int round = 0; round < most_rounds; ++round) {
    std::vector<double> both = shifts;
    for (std::size_t p = 0; p < pairs.size(); ++p)
      both[p] +=
          std::min(shifts_of_scans[pairs[p].source], shifts_of_scans[pairs[p].target]);
    const std::vector<PoseCandidate> candidates = candidatesOf(pairs, both);
    Consensus consensus = consensusOf(placed.descriptions, candidates);
    placed.poses = std::move(consensus.poses);
    placed.groups = std::move(consensus.groups);
    for (const PlacedGroup& group : placed.groups)
      solvePoses(placed.descriptions, group, linksOf(group, candidates, placed),
                 placed.poses);
    bool is_news = false;
    const std::vector<double> shown = shiftsOfAgreement(pairs, placed);
    for (std::size_t scan = 0; scan < shown.size(); ++scan)
      if (shown[scan] < shifts_of_scans[scan] - least_shift) {
        shifts_of_scans[scan] = shown[scan];
        is_news = true;
      }
    if (!is_news)
      return;
  }
}

} // namespace kss
} // namespace pcl
