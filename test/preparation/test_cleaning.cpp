/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "poses.h"

#include "preparation/cleaning.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

namespace {

using namespace kss_test;
using namespace pcl::kss;

using Coordinates = std::array<float, 3>;

std::set<Coordinates>
contentsOf(const Points& points)
{
  std::set<Coordinates> contents;
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    contents.insert({points(0, i), points(1, i), points(2, i)});
  return contents;
}

/** Points that know as many neighbours as cleaning asks for. */
Surface
surfaceOf(const Points& points)
{
  return {points, neighbourhoodsOf(points, 16, 1)};
}

/** How many of the points are left. */
Eigen::Index
left(const Points& points, const Points& rest)
{
  const auto contents = contentsOf(rest);
  Eigen::Index number = 0;
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    number += contents.count({points(0, i), points(1, i), points(2, i)});
  return number;
}

/** The mean distance of points to a dense sampling. */
double
distance(const Points& points, const Points& surface)
{
  double sum = 0.0;
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    sum += std::sqrt(
        (surface.colwise() - points.col(i)).colwise().squaredNorm().minCoeff());
  return sum / points.cols();
}

const Mesh ball = ellipsoid({0, 0, 0}, {1, 1, 1});

TEST(StrayPoints, AreDropped)
{
  for (const Mesh& mesh : {ball, lump()})
    for (const double share : {0.1, 0.2, 0.4})
      for (unsigned int seed = 1; seed < 3; ++seed) {
        const Points clean = sampled(mesh, 2000, seed);
        const Points mixed = withOutliers(clean, share, 10 + seed);
        const Points dense = sampled(mesh, 20000, 20 + seed);
        const Points rest = withoutStrayPoints(mixed, 1).points;
        // nothing new
        EXPECT_EQ(rest.cols(), left(rest, mixed));
        // the surface stays
        EXPECT_GT(left(clean, rest), 0.95 * clean.cols()) << share;
        // Of the strays that are off it by more than two spacings, hardly any; where
        // they are so many that they are not sparse any more, a minority.
        const Points strays = mixed.rightCols(mixed.cols() - clean.cols());
        Points open(3, 0);
        for (Eigen::Index i = 0; i < strays.cols(); ++i)
          if (distance(strays.col(i), dense) > 0.16) {
            open.conservativeResize(3, open.cols() + 1);
            open.rightCols<1>() = strays.col(i);
          }
        ASSERT_GT(open.cols(), 0.5 * strays.cols());
        EXPECT_LT(left(open, rest), (share < 0.3 ? 0.1 : 0.3) * open.cols())
            << share << ", " << seed;
      }
}

TEST(StrayPoints, AreNotThoseOfASurface)
{
  for (const Mesh& mesh : {ball, lump(), creature(), cross(), pennant()})
    for (const int number : {500, 5000}) {
      const Points cloud = sampled(mesh, number, 3);
      EXPECT_GT(withoutStrayPoints(cloud, 1).points.cols(), 0.97 * number) << number;
    }
}

TEST(StrayPoints, AreNotSparseParts)
{
  // The density falls a hundredfold from end to end, as with the distance from a
  // scanner.
  const Points even = sampled(lump(), 60000, 4);
  std::mt19937 random(5);
  std::uniform_real_distribution<float> share(0.0f, 1.0f);
  Points uneven(3, 0);
  for (Eigen::Index i = 0; i < even.cols(); ++i)
    if (share(random) < std::pow(10.0f, -0.9f * (even(0, i) + 1.2f))) {
      uneven.conservativeResize(3, uneven.cols() + 1);
      uneven.rightCols<1>() = even.col(i);
    }
  const Points rest = withoutStrayPoints(uneven, 1).points;
  EXPECT_GT(rest.cols(), 0.95 * uneven.cols());
  // where it is sparsest, too
  const auto behind = [](const Points& cloud) {
    return (cloud.row(0).array() > 0.5f).count();
  };
  ASSERT_GT(behind(uneven), 50);
  EXPECT_GT(behind(rest), 0.85 * behind(uneven));
}

TEST(StrayPoints, StayWhereNothingElseIs)
{
  for (const int number : {1, 2, 50, 99}) {
    const Points few = scattered(number, 6);
    EXPECT_EQ(few, withoutStrayPoints(few, 1).points);
  }
  const Points equal = Points::Constant(3, 300, 1.0f);
  EXPECT_EQ(equal, withoutStrayPoints(equal, 1).points);
  // points in space are the cloud, not astray from it
  EXPECT_GT(withoutStrayPoints(scattered(2000, 7), 1).points.cols(), 1500);
}

TEST(StrayPoints, AreTheSameWithAnyNumberOfThreadsAndInAnyUnit)
{
  const Points mixed = withOutliers(sampled(lump(), 2000, 8), 0.2, 9);
  const Points rest = withoutStrayPoints(mixed, 1).points;
  EXPECT_EQ(rest, withoutStrayPoints(mixed, 2).points);
  // powers of two round nothing
  for (const float unit : {1024.0f, 1.0f / 1024.0f})
    EXPECT_EQ(Points(unit * rest), withoutStrayPoints(unit * mixed, 1).points);
}

TEST(StrayPoints, LeaveTheirNeighboursNewOnes)
{
  // hardly any stray point, some, many; too few points to clean, and to have neighbours
  const Points clean = sampled(lump(), 2000, 30);
  for (const Points& cloud :
       {clean, withOutliers(clean, 0.001, 31), withOutliers(clean, 0.1, 32),
        withOutliers(clean, 0.4, 33), scattered(50, 34), scattered(5, 35),
        scattered(1, 36)}) {
    const Surface rest = withoutStrayPoints(cloud, 1);
    const Eigen::MatrixXi& indices = rest.neighbourhoods.indices;
    const Eigen::MatrixXf& distances = rest.neighbourhoods.distances;
    ASSERT_EQ(rest.points.cols(), indices.cols());
    ASSERT_GE(indices.rows(),
              std::min<Eigen::Index>(known_neighbours, rest.points.cols() - 1));
    for (Eigen::Index i = 0; i < rest.points.cols(); ++i) {
      Eigen::RowVectorXf away =
          (rest.points.colwise() - rest.points.col(i)).colwise().norm();
      std::set<int> others;
      for (Eigen::Index n = 0; n < indices.rows(); ++n) {
        ASSERT_NE(i, indices(n, i));
        ASSERT_TRUE(others.insert(indices(n, i)).second);
        ASSERT_NEAR(away[indices(n, i)], distances(n, i), 1e-6f);
      }
      away[i] = 0.0f;
      std::sort(away.data(), away.data() + away.size());
      for (Eigen::Index n = 0; n < indices.rows(); ++n)
        ASSERT_NEAR(away[n + 1], distances(n, i), 1e-6f) << i;
    }
  }
}

TEST(Noise, IsToldFromSurfaces)
{
  for (const Mesh& mesh : {ball, lump(), creature()})
    for (const int number : {1000, 5000}) {
      const Points clean = sampled(mesh, number, 10);
      EXPECT_FALSE(isNoisy(surfaceOf(clean), 1)) << number;
      EXPECT_FALSE(isNoisy(surfaceOf(noisy(clean, 0.005, 11)), 1)) << number;
    }
  EXPECT_FALSE(isNoisy(surfaceOf(sampled(pennant(), 3000, 12)), 1));
  for (const int number : {3000, 8000}) {
    // a tenth of the radius of the lump, several spacings
    const Points heavy = noisy(sampled(lump(), number, 13), 0.12, 14);
    EXPECT_TRUE(isNoisy(surfaceOf(heavy), 1)) << number;
    EXPECT_TRUE(isNoisy(surfaceOf(heavy), 2)) << number;
  }
  EXPECT_TRUE(isNoisy(surfaceOf(scattered(3000, 15)), 1));
  // too few to say
  for (const int number : {1, 3, 399})
    EXPECT_FALSE(isNoisy(surfaceOf(scattered(number, 16)), 1));
}

TEST(Noise, IsAveragedAway)
{
  const Points clean = sampled(lump(), 20000, 17);
  const Points a = noisy(sampled(lump(), 6000, 18), 0.1, 19);
  const Points b = noisy(sampled(lump(), 5000, 20), 0.1, 21);
  Points source = a, target = b;
  averageNoise(source, target, 1000, 1);
  EXPECT_LE(source.cols(), 1000);
  EXPECT_GT(source.cols(), 500);
  EXPECT_LE(target.cols(), 1000);
  EXPECT_GT(target.cols(), 500);
  for (const auto& pair : {std::make_pair(&a, &source), std::make_pair(&b, &target)}) {
    // a quarter of the error goes at least; the radius is not larger than needed
    EXPECT_LT(distance(*pair.second, clean), 0.75 * distance(*pair.first, clean));
    EXPECT_FALSE(isNoisy(surfaceOf(*pair.second), 1));
    // and the means still lie all around
    EXPECT_NEAR(0.0f, (pair.second->rowwise().mean() - clean.rowwise().mean()).norm(),
                0.12f);
  }
  Points source_too = a, target_too = b;
  averageNoise(source_too, target_too, 1000, 2);
  EXPECT_EQ(source, source_too);
  EXPECT_EQ(target, target_too);
}

} // namespace
