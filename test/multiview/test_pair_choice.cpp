/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "multiview/made_up_scans.h"
#include "multiview/pair_choice.h"

#include <Eigen/Geometry>

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

using namespace pcl::kss;

namespace {

/** A scan with features of its own at random points: the same ones where the seed is.
 */
ScanDescription
scanWith(unsigned int seed)
{
  std::mt19937 random(seed);
  std::normal_distribution<float> normal;
  ScanDescription scan;
  for (int i = 0; i < 30; ++i) {
    scan.outline.emplace_back(
        Eigen::Vector3f::NullaryExpr([&](Eigen::Index) { return normal(random); }));
    for (auto* const features : {&scan.wide_features, &scan.narrow_features})
      for (std::uint8_t& share : features->emplace_back())
        share = static_cast<std::uint8_t>(random() % 52);
  }
  return scan;
}

std::vector<ScanDescription>
scansWith(const std::vector<unsigned int>& seeds)
{
  std::vector<ScanDescription> scans;
  for (const unsigned int seed : seeds)
    scans.push_back(scanWith(seed));
  return scans;
}

Eigen::MatrixXf
none(Eigen::Index size)
{
  return Eigen::MatrixXf::Zero(size, size);
}

bool
has(const std::vector<ScanPair>& pairs, const ScanPair& pair)
{
  return std::find(pairs.begin(), pairs.end(), pair) != pairs.end();
}

PairResult
resultOf(std::size_t source, std::size_t target, double log_odds)
{
  PairResult result = made_up::resultOf(source, target);
  result.poses.front().log_odds = log_odds;
  return result;
}

TEST(PairChoice, TriesAllPairsOfFewScans)
{
  EXPECT_EQ(pairsToTry({}, {0, 1, 3}, 25, 8),
            (std::vector<ScanPair>{{0, 1}, {0, 3}, {1, 3}}));
}

TEST(PairChoice, TriesThoseThatResembleEachOtherOfMany)
{
  // 0 and 3, 1 and 4, 2 and 5 are alike
  const auto scans = scansWith({1, 2, 3, 1, 2, 3});
  const std::vector<std::size_t> all = {0, 1, 2, 3, 4, 5};
  const auto pairs = pairsToTry(resemblancesOf(scans, all, 2), all, 2, 1);
  EXPECT_TRUE(has(pairs, {0, 3}));
  EXPECT_TRUE(has(pairs, {1, 4}));
  EXPECT_TRUE(has(pairs, {2, 5}));
  // and those that follow each other, of 15 pairs
  EXPECT_TRUE(has(pairs, {2, 3}));
  EXPECT_EQ(pairs.size(), 8);
}

TEST(PairChoice, WantsTheMostPromisingPairsOfGroups)
{
  const std::vector<std::vector<std::size_t>> groups = {{0, 1, 2}, {3, 4, 5}};
  std::map<ScanPair, PairResult> tried;
  for (std::size_t a : {0, 1, 2})
    for (std::size_t b : {3, 4, 5})
      tried[{a, b}] = resultOf(a, b, -5.0 - static_cast<double>(a + b));
  const auto wanted =
      wantedPairs(none(6), {0, 1, 2, 3, 4, 5}, groups, tried, {{0, 3}}, 8);
  EXPECT_EQ(wanted.size(), 3);
  EXPECT_TRUE(has(wanted, {0, 4}));
  EXPECT_TRUE(has(wanted, {1, 3}));
}

TEST(PairChoice, WantsNothingOfOneGroup)
{
  EXPECT_TRUE(wantedPairs(none(2), {0, 1}, {{0, 1}}, {}, {}, 8).empty());
}

TEST(PairChoice, WantsNoPairsThatHaveNoPose)
{
  std::map<ScanPair, PairResult> tried;
  tried[{0, 1}].target = 1;
  EXPECT_TRUE(wantedPairs(none(2), {0, 1}, {{0}, {1}}, tried, {}, 8).empty());
}

TEST(PairChoice, SeesWhatResemblesItselfTurned)
{
  const ScanDescription scan = scanWith(1);
  ScanDescription turned = scan;
  for (Eigen::Vector3f& point : turned.outline)
    point = Eigen::AngleAxisf(1.0f, Eigen::Vector3f::UnitX()) * point;
  EXPECT_GT(resemblance(scan, turned), 25.0);
  EXPECT_LT(resemblance(scan, scanWith(2)), 10.0);
}

TEST(PairChoice, ComparesTheOctaveThatBothHave)
{
  const ScanDescription scan = scanWith(1);
  ScanDescription larger = scan;
  larger.octave = 1;
  larger.narrow_features = scan.wide_features;
  EXPECT_GT(resemblance(scan, larger), 25.0);
  larger.octave = 2;
  EXPECT_EQ(resemblance(scan, larger), 0.0);
}

} // namespace
