/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "multiview/placing.h"

#include "made_up_scans.h"

#include <gtest/gtest.h>

using namespace pcl::kss;

namespace {

using Groups = std::vector<PlacedGroup>;

PairResult
resultOf(std::size_t source,
         std::size_t target,
         const Eigen::Matrix4d& pose,
         double confidence)
{
  PairResult pair = made_up::resultOf(source, target, pose);
  pair.confidence = confidence;
  return pair;
}

TEST(Placing, DoubtsScansWhosePairsDisagreeAndNoOthers)
{
  constexpr std::size_t size = 14, sound = 4, half = 5;
  made_up::Scans scans(size);
  std::vector<PairResult> pairs;
  for (std::size_t i = 0; i < sound; ++i)
    for (std::size_t j = i + 1; j < sound; ++j)
      pairs.push_back(resultOf(i, j, scans.relative(i, j), 0.8));
  // sure, each of them, and wrong; there are no triangles that tell
  for (std::size_t i = sound; i < sound + half; ++i)
    for (std::size_t j = sound + half; j < size; ++j)
      pairs.push_back(resultOf(i, j, scans.randomPose(5.0), 0.7));
  PlacedScans placed;
  placed.descriptions = scans.descriptions;
  placeByPairs(pairs, std::vector<double>(pairs.size(), 0.0), placed);
  Groups expected = {{0, 1, 2, 3}};
  for (std::size_t i = sound; i < size; ++i)
    expected.push_back({i});
  EXPECT_EQ(placed.groups, expected);
  for (std::size_t i = 1; i < sound; ++i)
    EXPECT_LT(scans.error(0, i, placed.poses), 1e-6);
}

TEST(Placing, BelievesPairsLessThatAreOfMany)
{
  made_up::Scans scans(2);
  const std::vector<PairResult> pairs = {resultOf(0, 1, scans.relative(0, 1), 0.6)};
  PlacedScans placed;
  placed.descriptions = scans.descriptions;
  placeByPairs(pairs, {shiftOfMany(1, 2)}, placed);
  EXPECT_EQ(placed.groups, (Groups{{0, 1}}));
  placeByPairs(pairs, {shiftOfMany(400, 40)}, placed);
  EXPECT_EQ(placed.groups, (Groups{{0}, {1}}));
}

TEST(Placing, WantsMoreOfASinglePairAmongMany)
{
  constexpr std::size_t size = 30;
  made_up::Scans scans(size);
  std::vector<PairResult> pairs;
  for (std::size_t i = 0; i < size; ++i)
    for (std::size_t j = i + 1; j < size; ++j)
      pairs.push_back(resultOf(i, j, scans.randomPose(5.0), 0.03));
  pairs.front().confidence = 0.6;
  PlacedScans placed;
  placed.descriptions = scans.descriptions;
  placeByPairs(pairs,
               std::vector<double>(pairs.size(), shiftOfMany(pairs.size(), size)),
               placed);
  EXPECT_EQ(placed.groups.size(), size);
}

} // namespace
