/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "poses.h"

#include "geometry/nearest_points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <vector>

namespace {

using namespace kss_test;
using namespace pcl::kss;

/** How the search does at positions so far from points, as a share of the diagonal. */
struct Misses {
  double share = 0.0, worst_excess = 0.0;
};

Misses
missesOf(const Points& points, float away)
{
  const NearestPoints search(points, 1);
  EXPECT_EQ(points, search.points());
  std::mt19937 random(14);
  const float diagonal = std::max<float>(diagonalOf(points), 1e-3f);
  constexpr int positions = 2000;
  Misses misses;
  for (int i = 0; i < positions; ++i) {
    const Eigen::Vector3f position =
        points.col(i % points.cols()) +
        away * diagonal * randomVector(random, 1.0).cast<float>();
    float squared, near_squared;
    const int found = search.nearest(position, squared);
    const int near = search.near(position, near_squared);
    // whichever it is: it exists, and so far away it is
    EXPECT_TRUE(found >= 0 && found < points.cols());
    EXPECT_FLOAT_EQ((points.col(found) - position).squaredNorm(), squared);
    EXPECT_FLOAT_EQ((points.col(near) - position).squaredNorm(), near_squared);
    EXPECT_LE(squared, near_squared);
    const double excess =
        (std::sqrt(squared) - distanceTo(points, position)) / diagonal;
    misses.share += (excess > 1e-5) / static_cast<double>(positions);
    misses.worst_excess = std::max(misses.worst_excess, excess);
  }
  return misses;
}

TEST(NearestPoints, AreThoseOfBruteForceOnTheSurface)
{
  for (const Points& points : {sampled(creature(), 3000, 15), sampled(lump(), 1000, 16),
                               scattered(2000, 17), sampled(pennant(), 1000, 18)})
    for (const float away : {1e-3f, 1e-2f}) {
      const Misses misses = missesOf(points, away);
      EXPECT_LT(misses.share, 0.006);
      EXPECT_LT(misses.worst_excess, 0.03); // a spacing
    }
}

TEST(NearestPoints, AreHardlyFartherInTheNeighbourhood)
{
  for (const Points& points : {sampled(creature(), 3000, 15), sampled(lump(), 1000, 16),
                               scattered(2000, 17), sampled(pennant(), 1000, 18)})
    for (const float away : {0.03f, 0.1f}) {
      const Misses misses = missesOf(points, away);
      EXPECT_LT(misses.share, 0.06);
      EXPECT_LT(misses.worst_excess, 0.03);
    }
}

TEST(NearestPoints, AreThereForAnyCloud)
{
  for (const Points& points : {scattered(1, 19), Points(Points::Constant(3, 30, 0.5f))})
    EXPECT_EQ(0.0, missesOf(points, 0.1f).share);
  for (const int number : {2, 3, 9})
    EXPECT_LT(missesOf(scattered(number, 20), 0.1f).share, 0.02);
}

TEST(NearestPoints, KnowHowNearTheSecondIs)
{
  for (const Points& points : {sampled(creature(), 2000, 23), sampled(lump(), 1000, 24),
                               scattered(2000, 25), sampled(pennant(), 1000, 26)}) {
    const NearestPoints search(points, 1);
    std::mt19937 random(27);
    constexpr int positions = 1000;
    int too_far = 0;
    for (int i = 0; i < positions; ++i) {
      const Eigen::Vector3f position =
          points.col(i) + randomVector(random, 0.02).cast<float>();
      float squared, second, alone;
      const int found = search.nearest(position, squared, second);
      EXPECT_EQ(found, search.nearest(position, alone));
      EXPECT_EQ(squared, alone);
      Eigen::RowVectorXf others = (points.colwise() - position).colwise().squaredNorm();
      EXPECT_FLOAT_EQ(others[found], squared);
      others[found] = std::numeric_limits<float>::max();
      // that of a point, and of another one
      EXPECT_GE(second, others.minCoeff() * (1.0f - 1e-5f));
      EXPECT_LE((others.array() - second).abs().minCoeff(), 1e-5f * second);
      too_far += second > others.minCoeff() * (1.0f + 1e-5f);
    }
    EXPECT_LT(too_far, 0.02 * positions);
  }
  float squared, second;
  const NearestPoints one(Points::Constant(3, 1, 0.5f), 1);
  EXPECT_EQ(0, one.nearest({0.5f, 0.5f, 1.5f}, squared, second));
  EXPECT_EQ(1.0f, squared);
  EXPECT_EQ(std::numeric_limits<float>::infinity(), second);
  const NearestPoints copies(Points::Constant(3, 20, 0.5f), 1);
  copies.nearest({0.5f, 0.5f, 1.5f}, squared, second);
  EXPECT_EQ(1.0f, squared);
  EXPECT_EQ(1.0f, second);
}

TEST(NearestPoints, AreTheSameForPointsThatKnowTheirNeighbours)
{
  const Points points = sampled(creature(), 1000, 28);
  const NearestPoints reference(points, 1);
  for (const int neighbours : {12, 16, 30}) {
    const NearestPoints search(points, neighbourhoodsOf(points, neighbours, 1));
    EXPECT_EQ(reference.spacing(), search.spacing());
    for (int i = 0; i < 500; ++i) {
      const Eigen::Vector3f position =
          points.col(i) + Eigen::Vector3f(0.02f, 0, -0.03f);
      float expected, found;
      EXPECT_EQ(reference.nearest(position, expected), search.nearest(position, found));
      EXPECT_EQ(expected, found);
    }
  }
}

TEST(NearestPoints, KnowTheSpacing)
{
  const Points points = sampled(creature(), 2000, 22);
  const NearestPoints search(points, 2);
  EXPECT_EQ(spacingOf(neighbourhoodsOf(points, 10, 1)), search.spacing());
}

} // namespace
