/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "multiview/pair_choice.h"

#include "multiview/partners.h"

#include "support/parallel.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

namespace pcl {
namespace kss {
namespace {

/** Of two groups, so many pairs at a time. */
constexpr std::size_t pairs_of_groups = 3;

/** Pairs that have not been tried are tried after those whose poses have better odds,
 * as a logarithm, than this. */
constexpr double untried_log_odds = -5.0;

/** Each scan is to have so many pairs that agree with the model, as far as there are
 * others that it overlaps by so much of both. */
constexpr std::size_t enough_confirmations = 4;
constexpr double confirming_overlap = 0.5;

/** Points of two scans whose features are each other's nearest. */
using Match = std::pair<Eigen::Index, Eigen::Index>;

/** Features as columns. */
Eigen::MatrixXf
columnsOf(const std::vector<LocalFeature>& features)
{
  constexpr int rows = std::tuple_size<LocalFeature>::value;
  return Eigen::Map<const Eigen::Matrix<std::uint8_t, rows, Eigen::Dynamic>>(
             features.empty() ? nullptr : features.front().data(), rows,
             static_cast<Eigen::Index>(features.size()))
      .cast<float>();
}

std::vector<Match>
mutualMatches(const std::vector<LocalFeature>& a, const std::vector<LocalFeature>& b)
{
  std::vector<Match> matches;
  const Eigen::MatrixXf products = columnsOf(a).transpose() * columnsOf(b);
  if (products.size() == 0)
    return matches;
  std::vector<Eigen::Index> best_of_b(products.cols());
  for (Eigen::Index j = 0; j < products.cols(); ++j)
    products.col(j).maxCoeff(&best_of_b[j]);
  for (Eigen::Index i = 0; i < products.rows(); ++i) {
    Eigen::Index j;
    products.row(i).maxCoeff(&j);
    if (best_of_b[j] == i)
      matches.emplace_back(i, j);
  }
  return matches;
}

} // namespace

std::vector<std::size_t>
groupOfEach(const std::vector<std::vector<std::size_t>>& groups, std::size_t scans)
{
  std::vector<std::size_t> group_of(scans);
  for (std::size_t g = 0; g < groups.size(); ++g)
    for (const std::size_t scan : groups[g])
      group_of[scan] = g;
  return group_of;
}

double
resemblance(const ScanDescription& a, const ScanDescription& b)
{
  // the widest octave that both have
  const int octave = std::min(a.octave, b.octave);
  if (std::max(a.octave, b.octave) - octave > 1)
    return 0.0;
  const auto featuresOf = [octave](const ScanDescription& scan) -> const auto&
  {
    return scan.octave == octave ? scan.wide_features : scan.narrow_features;
  };
  const std::vector<Match> matches = mutualMatches(featuresOf(a), featuresOf(b));

  // of right matches, distances between points are the same in both
  const double tolerance = 0.1 * std::ldexp(1.0, octave);
  int most = 0;
  for (const Match& one : matches) {
    int agreeing = 0;
    for (const Match& other : matches) {
      const double in_a = (a.outline[one.first] - a.outline[other.first]).norm();
      const double in_b = (b.outline[one.second] - b.outline[other.second]).norm();
      if (in_a > 2.0 * tolerance && std::abs(in_a - in_b) < tolerance)
        ++agreeing;
    }
    most = std::max(most, agreeing);
  }
  return most;
}

Eigen::MatrixXf
resemblancesOf(const std::vector<ScanDescription>& scans,
               const std::vector<std::size_t>& usable,
               unsigned int threads)
{
  Eigen::MatrixXf resemblances = Eigen::MatrixXf::Zero(scans.size(), scans.size());
  inParallel(static_cast<std::ptrdiff_t>(usable.size()), threads, 1,
             [&](std::ptrdiff_t i) {
               const std::size_t a = usable[i];
               for (const std::size_t b : usable)
                 if (a < b)
                   resemblances(a, b) = resemblances(b, a) =
                       static_cast<float>(resemblance(scans[a], scans[b]));
             });
  return resemblances;
}

std::vector<ScanPair>
pairsToTry(const Eigen::MatrixXf& resemblances,
           const std::vector<std::size_t>& usable,
           std::size_t all_pairs,
           std::size_t partners)
{
  std::set<ScanPair> pairs;
  const auto add = [&pairs](std::size_t a, std::size_t b) {
    pairs.insert({std::min(a, b), std::max(a, b)});
  };
  if (usable.size() <= std::max<std::size_t>(all_pairs, partners)) {
    for (const std::size_t a : usable)
      for (const std::size_t b : usable)
        if (a < b)
          add(a, b);
    return {pairs.begin(), pairs.end()};
  }
  for (std::size_t i = 0; i < usable.size(); ++i) {
    const std::size_t scan = usable[i];
    if (i + 1 < usable.size())
      add(scan, usable[i + 1]);
    std::vector<std::pair<double, std::size_t>> others;
    for (const std::size_t other : usable)
      if (other != scan)
        others.emplace_back(-resemblances(scan, other), other);
    std::partial_sort(others.begin(), others.begin() + partners, others.end());
    for (std::size_t p = 0; p < partners; ++p)
      add(scan, others[p].second);
  }
  return {pairs.begin(), pairs.end()};
}

namespace {

/** A pair of scans, the most promising one first. */
using Promising = std::pair<double, ScanPair>;

/** The pairs between two groups, the lower number of these first. */
using PairsBetween =
    std::map<std::pair<std::size_t, std::size_t>, std::vector<Promising>>;

PairsBetween
pairsBetween(const Eigen::MatrixXf& resemblances,
             const std::vector<std::size_t>& usable,
             const std::vector<std::vector<std::size_t>>& groups,
             const std::map<ScanPair, PairResult>& tried)
{
  const std::vector<std::size_t> group_of = groupOfEach(groups, resemblances.rows());
  PairsBetween between;
  for (const std::size_t a : usable)
    for (const std::size_t b : usable) {
      if (a >= b || group_of[a] == group_of[b])
        continue;
      const auto found = tried.find({a, b});
      if (found != tried.end() && found->second.poses.empty())
        continue; // they are too different for a pose
      const double promise = found == tried.end()
                                 ? untried_log_odds - 1.0 / (1.0 + resemblances(a, b))
                                 : found->second.poses.front().log_odds;
      between[std::minmax(group_of[a], group_of[b])].push_back({-promise, {a, b}});
    }
  for (auto& [both, pairs] : between)
    std::sort(pairs.begin(), pairs.end());
  return between;
}

std::vector<std::pair<std::size_t, std::size_t>>
resemblingGroups(const PairsBetween& between, std::size_t partners)
{
  Partners partners_of;
  for (const auto& [both, pairs] : between)
    partners_of.add(pairs.front().first, both);
  const auto resembling = partners_of.best([=](std::size_t) { return partners; });
  return {resembling.begin(), resembling.end()};
}

} // namespace

std::vector<ScanPair>
wantedPairs(const Eigen::MatrixXf& resemblances,
            const std::vector<std::size_t>& usable,
            const std::vector<std::vector<std::size_t>>& groups,
            const std::map<ScanPair, PairResult>& tried,
            const std::set<ScanPair>& thorough,
            std::size_t partners)
{
  PairsBetween between = pairsBetween(resemblances, usable, groups, tried);
  for (auto both = between.begin(); both != between.end();) {
    std::vector<Promising>& pairs = both->second;
    pairs.erase(std::remove_if(
                    pairs.begin(), pairs.end(),
                    [&](const Promising& pair) { return thorough.count(pair.second); }),
                pairs.end());
    both = pairs.empty() ? between.erase(both) : std::next(both);
  }
  std::vector<ScanPair> wanted;
  for (const auto& both : resemblingGroups(between, partners)) {
    const std::vector<Promising>& pairs = between.at(both);
    for (std::size_t p = 0; p < std::min(pairs_of_groups, pairs.size()); ++p)
      wanted.push_back(pairs[p].second);
  }
  return wanted;
}

std::vector<std::pair<std::size_t, std::size_t>>
resemblingGroups(const Eigen::MatrixXf& resemblances,
                 const std::vector<std::size_t>& usable,
                 const std::vector<std::vector<std::size_t>>& groups,
                 const std::map<ScanPair, PairResult>& tried,
                 std::size_t partners)
{
  return resemblingGroups(pairsBetween(resemblances, usable, groups, tried), partners);
}

std::set<ScanPair>
pairsThatConfirm(const PlacedScans& placed, const std::map<ScanPair, PairResult>& tried)
{
  std::map<std::size_t, std::size_t> confirmations;
  Partners more;
  for (const PlacedGroup& group : placed.groups)
    for (const std::size_t a : group)
      for (const std::size_t b : group) {
        if (a >= b)
          continue;
        const auto found = tried.find({a, b});
        if (found != tried.end()) {
          const std::size_t agrees = placed.isKept(found->second) ? 1 : 0;
          confirmations[a] += agrees;
          confirmations[b] += agrees;
          continue;
        }
        const double overlap = placed.overlapOf(a, b).least;
        if (overlap >= confirming_overlap)
          more.add(-overlap, {a, b});
      }
  return more.best([&](std::size_t scan) {
    return enough_confirmations - std::min(enough_confirmations, confirmations[scan]);
  });
}

} // namespace kss
} // namespace pcl
