/*
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * How much lies on each other, and what is concluded from that.
 */

#include "poses.h"

#include <pcl/registration/kss/result.h>

#include "refinement/overlap.h"

#include <gtest/gtest.h>

namespace {

using namespace kss_test;
using namespace pcl::kss;

const Eigen::Matrix4d identity = Eigen::Matrix4d::Identity();

Overlap
overlapOf(const Points& source,
          const Points& target,
          const Eigen::Matrix4d& pose = identity)
{
  return overlapAt(NearestPoints(source, 1), NearestPoints(target, 1),
                   Similarity::of(pose));
}

TEST(Overlap, IsFullForACloudAndItself)
{
  const Points cloud = sampled(creature(), 1000, 1);
  const Overlap same = overlapOf(cloud, cloud);
  EXPECT_EQ(1.0, same.source);
  EXPECT_EQ(1.0, same.target);
  EXPECT_NEAR(2.0, same.score, 1e-6);
  // at the pose that brings it there
  const Eigen::Matrix4d truth = randomSimilarity(2);
  const Overlap placed = overlapOf(transformed(cloud, truth.inverse()), cloud, truth);
  EXPECT_EQ(1.0, placed.source);
  EXPECT_EQ(1.0, placed.target);
  EXPECT_NEAR(2.0, placed.score, 1e-4);
}

TEST(Overlap, IsThreeHalvesForTwoSamplings)
{
  // whatever the shape, the density and the unit
  for (const Mesh& mesh : {creature(), lump(), cross(), pennant()})
    for (const int number : {400, 4000}) {
      const Points a = sampled(mesh, number, 3), b = sampled(mesh, number, 4);
      const Overlap overlap = overlapOf(a, b);
      EXPECT_GT(overlap.source, 0.97) << number;
      EXPECT_GT(overlap.target, 0.97) << number;
      EXPECT_NEAR(1.5, overlap.score, 0.12) << number;
      EXPECT_NEAR(overlap.score, overlapOf(1e3f * a, 1e3f * b).score, 1e-3);
    }
  EXPECT_NEAR(1.5,
              overlapOf(noisy(sampled(lump(), 3000, 5), 0.02, 6),
                        noisy(sampled(lump(), 3000, 7), 0.02, 8))
                  .score,
              0.2);
  // where noise fills space, spacings are those of space; it is still far from doubtful
  EXPECT_GT(overlapOf(noisy(sampled(lump(), 3000, 5), 0.1, 6),
                      noisy(sampled(lump(), 3000, 7), 0.1, 8))
                .score,
            1.0);
  // densities of one to ten
  EXPECT_NEAR(1.5, overlapOf(sampled(lump(), 400, 9), sampled(lump(), 4000, 10)).score,
              0.3);
}

TEST(Overlap, IsTheShareThatIsCovered)
{
  const Points whole = sampled(lump(), 4000, 11);
  for (const double share : {0.3, 0.5, 0.8}) {
    const Points cut = part(sampled(lump(), 4000, 12), {1, 1, 0}, share);
    const Overlap there = overlapOf(cut, whole), back = overlapOf(whole, cut);
    EXPECT_GT(there.source, 0.97);
    // a spacing beyond the border counts, too
    EXPECT_NEAR(share, there.target, 0.08);
    EXPECT_NEAR(share, back.source, 0.08);
    EXPECT_GT(back.target, 0.97);
    EXPECT_NEAR(0.75 * (1.0 + share), there.score, 0.12);
    EXPECT_NEAR(there.score, back.score, 1e-3);
  }
}

TEST(Overlap, TellsRightFromWrong)
{
  const Points a = sampled(creature(), 2000, 13), b = sampled(creature(), 2000, 14);
  EXPECT_LT(overlapOf(a, b, turn(60.0, {0.0, 1.0, 0.0})).score, 0.5);
  EXPECT_LT(overlapOf(a, b, turn(5.0, {0.0, 1.0, 0.0})).score, overlapOf(a, b).score);
  Eigen::Matrix4d off = identity;
  off(0, 3) = 100.0;
  const Overlap none = overlapOf(a, b, off);
  EXPECT_EQ(0.0, none.source);
  EXPECT_EQ(0.0, none.target);
  EXPECT_EQ(0.0, none.score);
}

TEST(Overlap, IsToldBySomeOfThePointsAsByAll)
{
  const Points a = part(sampled(lump(), 6000, 17), {1, 0, 0}, 0.6);
  const NearestPoints source(a, 1), target(sampled(lump(), 6000, 18), 1);
  const Overlap all = overlapAt(source, target, Similarity());
  for (const Eigen::Index most : {500, 1000, 3000}) {
    const Overlap some = overlapAt(source, target, Similarity(), most);
    EXPECT_NEAR(all.source, some.source, 0.02) << most;
    EXPECT_NEAR(all.target, some.target, 0.06) << most;
    EXPECT_NEAR(all.score, some.score, 0.08) << most;
  }
  // all where there are no more
  for (const Eigen::Index most : {6000, 100000})
    EXPECT_EQ(all.score, overlapAt(source, target, Similarity(), most).score);
}

TEST(Overlap, CannotBeBoughtWithScale)
{
  // a source shrunk to a speck lies on the target, but does not cover it
  const Points a = sampled(lump(), 2000, 15), b = sampled(lump(), 2000, 16);
  const Eigen::Matrix4d speck =
      similarity(Eigen::Quaterniond::Identity(), 1e-3, b.col(0).cast<double>());
  EXPECT_LT(overlapOf(a, b, speck).target, 0.05);
  EXPECT_LT(overlapOf(a, b, speck).score, overlapOf(a, b).score);
}

TEST(Mode, IsWhatTheOverlapSpeaksFor)
{
  EXPECT_EQ(Mode::GLOBAL_GLOBAL, modeOf({0.99, 0.95, 1.5}));
  EXPECT_EQ(Mode::PARTIAL_GLOBAL, modeOf({0.99, 0.5, 1.1}));
  EXPECT_EQ(Mode::PARTIAL_GLOBAL, modeOf({0.4, 0.97, 1.0}));
  EXPECT_EQ(Mode::PARTIAL_PARTIAL, modeOf({0.6, 0.5, 0.8}));
}

} // namespace
