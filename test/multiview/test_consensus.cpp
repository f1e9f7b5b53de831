/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "multiview/consensus.h"
#include "multiview/made_up_scans.h"

#include <gtest/gtest.h>

using namespace pcl::kss;

namespace {

using Groups = std::vector<PlacedGroup>;

Consensus
consensusOf(const made_up::Scans& scans)
{
  return consensusOf(scans.descriptions, scans.candidates);
}

TEST(Consensus, UnitesWhatPairsConnect)
{
  made_up::Scans scans(4);
  scans.add(0, 1, scans.relative(0, 1), 0.9);
  scans.add(2, 1, scans.relative(2, 1), 0.9);
  const Consensus consensus = consensusOf(scans);
  EXPECT_EQ(consensus.groups, (Groups{{0, 1, 2}, {3}}));
  EXPECT_LT(scans.error(0, 1, consensus.poses), 1e-9);
  EXPECT_LT(scans.error(0, 2, consensus.poses), 1e-9);
}

TEST(Consensus, LeavesWhatIsImprobable)
{
  made_up::Scans scans(2);
  scans.add(0, 1, scans.relative(0, 1), 0.4);
  EXPECT_EQ(consensusOf(scans).groups, (Groups{{0}, {1}}));
}

TEST(Consensus, BelievesPairsThatAgree)
{
  made_up::Scans scans(3);
  scans.add(0, 1, scans.relative(0, 1), 0.9);
  scans.add(0, 2, scans.relative(0, 2), 0.45);
  scans.add(1, 2, scans.relative(1, 2), 0.45);
  const Consensus consensus = consensusOf(scans);
  EXPECT_EQ(consensus.groups, (Groups{{0, 1, 2}}));
  EXPECT_LT(scans.error(0, 2, consensus.poses), 1e-9);
}

/** Two sides of a square, each of them sure of itself: twenty-five pairs that are
 * unsure, and a corner with two that are surer. */
void
expectSquare(double unsure, double one, double other)
{
  made_up::Scans scans(10);
  const Eigen::Matrix4d wrong = scans.randomPose(5.0);
  for (std::size_t i = 0; i < 5; ++i)
    for (std::size_t j = 0; j < 5; ++j) {
      scans.add(i, 5 + j, inverted(scans.poses[5 + j]) * wrong * scans.poses[i],
                unsure);
      if (i < j) {
        scans.add(i, j, scans.relative(i, j), 0.9);
        scans.add(5 + i, 5 + j, scans.relative(5 + i, 5 + j), 0.9);
      }
    }
  EXPECT_EQ(consensusOf(scans).groups, (Groups{{0, 1, 2, 3, 4}, {5, 6, 7, 8, 9}}));
  scans.add(4, 5, scans.relative(4, 5), one);
  scans.add(3, 5, scans.relative(3, 5), other);
  const Consensus consensus = consensusOf(scans);
  ASSERT_EQ(consensus.groups.size(), 1);
  EXPECT_LT(scans.error(0, 9, consensus.poses), 1e-6);
}

TEST(Consensus, DoesNotBelieveImprobablePairsBecauseThereAreManyOfThem)
{
  expectSquare(0.3, 0.8, 0.7);
  expectSquare(0.2, 0.6, 0.5);
}

TEST(Consensus, DoesNotBelieveImprobablePairsThatDisagree)
{
  made_up::Scans scans(3);
  scans.add(0, 1, scans.relative(0, 1), 0.9);
  scans.add(0, 2, scans.randomPose(5.0), 0.3);
  scans.add(1, 2, scans.randomPose(5.0), 0.3);
  EXPECT_EQ(consensusOf(scans).groups, (Groups{{0, 1}, {2}}));
}

/** Around a block, with a fifth of wrong pairs. */
void
expectBlock(double wrong_pair, double right_pair)
{
  made_up::Scans scans(40);
  for (std::size_t i = 0; i < 40; ++i) { // around a block, one radius apart
    const Eigen::AngleAxisd turn(2.0 * M_PI * i / 40.0, Eigen::Vector3d::UnitZ());
    scans.descriptions[i].centroid.setZero();
    scans.poses[i] = (turn * Eigen::Translation3d(17.0, 0.0, 0.0)).matrix();
  }
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < 40; ++i)
    for (std::size_t next = 1; next <= 3; ++next) {
      const std::size_t j = (i + next) % 40;
      const bool is_wrong = uniform(random) < 0.2;
      wrong += is_wrong ? 1 : 0;
      scans.add(i, j,
                is_wrong ? scans.randomPose(20.0)
                         : scans.disturbed(scans.relative(i, j), 0.005, 0.02),
                is_wrong ? wrong_pair : right_pair);
    }
  ASSERT_GT(wrong, 15);
  const Consensus consensus = consensusOf(scans);
  ASSERT_EQ(consensus.groups.size(), 1);
  for (std::size_t i = 1; i < 40; ++i)
    EXPECT_LT(scans.error(0, i, consensus.poses), 2.0) << i;
}

TEST(Consensus, IsNotLedAstrayByAFifthOfWrongPairsThatAreSure)
{
  expectBlock(0.9, 0.8);
  expectBlock(0.78, 0.54);
}

TEST(Consensus, TakesThePoseOfAnAmbiguousPairThatOthersAgreeWith)
{
  made_up::Scans scans(3);
  scans.add(0, 1, scans.randomPose(5.0), 0.5);
  scans.candidates.push_back({0, 1, 0, 1, scans.relative(0, 1), 0.45});
  scans.add(0, 2, scans.relative(0, 2), 0.9);
  scans.add(1, 2, scans.relative(1, 2), 0.9);
  const Consensus consensus = consensusOf(scans);
  ASSERT_EQ(consensus.groups.size(), 1);
  EXPECT_LT(scans.error(0, 1, consensus.poses), 1e-9);
}

TEST(Candidates, AreAsProbableAsTheirPairSays)
{
  PairResult pair;
  pair.source = 3;
  pair.target = 5;
  pair.confidence = 0.8;
  pair.poses.resize(3);
  pair.poses[0].log_odds = 1.0;
  pair.poses[1].log_odds = 1.0;
  pair.poses[2].log_odds = -9.0;
  const auto candidates = candidatesOf({PairResult(), pair});
  ASSERT_EQ(candidates.size(), 2);
  EXPECT_EQ(candidates[1].pair, 1);
  EXPECT_EQ(candidates[1].pose, 1);
  EXPECT_EQ(candidates[1].source, 3);
  EXPECT_EQ(candidates[1].target, 5);
  EXPECT_NEAR(candidates[0].probability, 0.4, 1e-3);
  EXPECT_NEAR(candidates[1].probability, 0.4, 1e-3);
}

} // namespace
