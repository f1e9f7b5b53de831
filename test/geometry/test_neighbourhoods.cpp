/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "poses.h"

#include "geometry/neighbourhoods.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <vector>

namespace {

using namespace kss_test;
using namespace pcl::kss;

TEST(Neighbourhoods, AreTheNearestOthers)
{
  const Points points = sampled(creature(), 1500, 1);
  const Neighbourhoods found = neighbourhoodsOf(points, 12, 2);
  ASSERT_EQ(12, found.indices.rows());
  ASSERT_EQ(1500, found.indices.cols());
  for (Eigen::Index i = 0; i < points.cols(); i += 7) {
    Eigen::RowVectorXf others = (points.colwise() - points.col(i)).colwise().norm();
    others[i] = 100.0f;
    std::vector<float> expected(others.data(), others.data() + others.size());
    std::sort(expected.begin(), expected.end());
    for (int n = 0; n < 12; ++n) {
      EXPECT_NE(i, found.indices(n, i));
      EXPECT_NEAR(expected[n], found.distances(n, i), 1e-5f);
      EXPECT_NEAR(others[found.indices(n, i)], found.distances(n, i), 1e-5f);
    }
  }
}

/** The neighbourhoods are those of brute force, distance by distance; which points,
 * where several are equally far, is free. */
void
expectNearest(const Points& points, int neighbours)
{
  const Neighbourhoods found = neighbourhoodsOf(points, neighbours, 1);
  const Eigen::Index k = std::min<Eigen::Index>(neighbours, points.cols() - 1);
  ASSERT_EQ(k, found.indices.rows());
  ASSERT_EQ(k, found.distances.rows());
  ASSERT_EQ(points.cols(), found.indices.cols());
  std::size_t wrong = 0;
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const auto distance = [&](Eigen::Index j) {
      return (points.col(j) - points.col(i)).norm();
    };
    std::vector<float> expected;
    for (Eigen::Index j = 0; j < points.cols(); ++j)
      if (j != i)
        expected.push_back(distance(j));
    std::partial_sort(expected.begin(), expected.begin() + k, expected.end());
    std::set<int> others{static_cast<int>(i)};
    for (Eigen::Index n = 0; n < k; ++n) {
      const int other = found.indices(n, i);
      ASSERT_TRUE(other >= 0 && other < points.cols());
      ASSERT_TRUE(others.insert(other).second) << "twice, or the point itself";
      ASSERT_FLOAT_EQ(distance(other), found.distances(n, i));
      // rounding aside
      wrong += std::abs(found.distances(n, i) - expected[n]) > 1e-6f * expected[n];
    }
  }
  EXPECT_EQ(0u, wrong) << "of " << k * points.cols();
}

Points
withCopies(Points points, Eigen::Index copies)
{
  points.leftCols(copies) = points.rightCols<1>().replicate(1, copies);
  return points;
}

TEST(Neighbourhoods, AreThoseOfBruteForceWhateverTheShape)
{
  Points row(3, 1000), thick = scattered(1500, 30);
  for (Eigen::Index i = 0; i < row.cols(); ++i)
    row.col(i) = Eigen::Vector3f(1.0f, 2.0f, -1.0f) * static_cast<float>(i);
  thick.row(0) *= 1000.0f;
  for (const Points& points :
       {sampled(creature(), 1500, 31), sampled(pennant(), 1500, 32), row, square(35),
        scattered(1500, 33), thick, Points(Points::Constant(3, 150, 2.5f)),
        Points((scattered(1500, 34).array() * 8.0f).exp()),
        Points(sampled(creature(), 1500, 35).array() + 1000.0f)})
    for (const int neighbours : {1, 6, 12, 16, 40})
      expectNearest(points, neighbours);
}

TEST(Neighbourhoods, AreThoseOfBruteForceAmongCopies)
{
  for (const Eigen::Index copies : {5, 40, 96, 97, 98, 200, 400})
    for (const int neighbours : {1, 12, 16})
      expectNearest(withCopies(sampled(creature(), 1000, 36), copies), neighbours);
}

TEST(Neighbourhoods, AreThoseOfBruteForceInTinyClouds)
{
  for (Eigen::Index number = 1; number < 30; ++number)
    for (const int neighbours : {1, 12, 16})
      expectNearest(scattered(number, 37), neighbours);
  expectNearest(withCopies(scattered(5, 38), 3), 12);
}

TEST(Neighbourhoods, AreFoundWhateverTheirDistances)
{
  // squares that are infinite, or nothing
  for (const float size : {1e-45f, 1e-38f, 1e-30f, 1e15f, 1e20f, 1e30f, 3e38f}) {
    Points points = 1e-4f * size * scattered(300, 39);
    points.rightCols<3>() *= 1e4f; // nothing in the cells around them
    const Neighbourhoods found = neighbourhoodsOf(points, 12, 1);
    EXPECT_GE(found.indices.minCoeff(), 0);
    EXPECT_LT(found.indices.maxCoeff(), 300);
  }
}

TEST(Neighbourhoods, AreThoseOfBruteForceNearStrayPoints)
{
  for (const float distance : {1e1f, 1e2f, 1e3f, 1e4f, 1e5f, 1e6f})
    for (const Eigen::Vector3f& direction :
         {Eigen::Vector3f(1, 1, 1), Eigen::Vector3f(-1, -1, -1),
          Eigen::Vector3f(-1, 0, 0), Eigen::Vector3f(0, 1, -1)}) {
      SCOPED_TRACE(::testing::Message()
                   << distance << " along " << direction.transpose());
      Points points = sampled(creature(), 1500, 39);
      points.col(17) = distance * direction;
      expectNearest(points, 12);
      // two clusters, far apart
      points.rightCols(400).colwise() += distance * direction;
      expectNearest(points, 12);
    }
}

TEST(Neighbourhoods, AreThoseOfBruteForceWhereAStrayPointMakesCoordinatesCoarse)
{
  // from there, coordinates are rounded to a tenth of a cell
  Points points = sampled(creature(), 8000, 5);
  points.col(17).setConstant(-1.2e5f);
  expectNearest(points, 12);
}

TEST(Neighbourhoods, AreThoseOfTheRestWithoutOthers)
{
  const Points points = sampled(creature(), 800, 40);
  const Neighbourhoods all = neighbourhoodsOf(points, 16, 1);
  for (const int every : {800, 50, 2}) {
    std::vector<int> kept;
    for (int i = 0; i < points.cols(); ++i)
      if (i % every != 1)
        kept.push_back(i);
    Points rest(3, kept.size());
    for (std::size_t i = 0; i < kept.size(); ++i)
      rest.col(i) = points.col(kept[i]);
    const Neighbourhoods found = withoutOthers(all, kept, rest, 1);
    const Neighbourhoods expected = neighbourhoodsOf(rest, 16, 1);
    EXPECT_EQ(expected.indices, found.indices) << every;
    EXPECT_EQ(expected.distances, found.distances) << every;
  }
}

TEST(Neighbourhoods, AreThoseOfFewerPointsWithoutOthers)
{
  const Points points = sampled(creature(), 30, 41);
  const Neighbourhoods all = neighbourhoodsOf(points, 16, 1);
  const std::vector<int> kept = {0, 3, 7, 12, 29};
  Points rest(3, kept.size());
  for (std::size_t i = 0; i < kept.size(); ++i)
    rest.col(i) = points.col(kept[i]);
  const Neighbourhoods found = withoutOthers(all, kept, rest, 1);
  EXPECT_EQ(4, found.indices.rows());
  EXPECT_EQ(neighbourhoodsOf(rest, 16, 1).indices, found.indices);
}

TEST(Neighbourhoods, DoNotDependOnThreads)
{
  const Points points = sampled(creature(), 1500, 2);
  const Neighbourhoods one = neighbourhoodsOf(points, 9, 1);
  const Neighbourhoods two = neighbourhoodsOf(points, 9, 2);
  EXPECT_EQ(one.indices, two.indices);
  EXPECT_EQ(one.distances, two.distances);
  EXPECT_EQ(surfaceVariation(points, one, 1), surfaceVariation(points, one, 2));
}

TEST(Neighbourhoods, AreSmallerInSmallClouds)
{
  const Points points = sampled(creature(), 5, 3);
  const Neighbourhoods found = neighbourhoodsOf(points, 10, 1);
  ASSERT_EQ(4, found.indices.rows());
  for (Eigen::Index i = 0; i < 5; ++i) {
    std::set<int> all{static_cast<int>(i)};
    for (int n = 0; n < 4; ++n)
      all.insert(found.indices(n, i));
    EXPECT_EQ((std::set<int>{0, 1, 2, 3, 4}), all);
  }
  EXPECT_EQ(0, neighbourhoodsOf(points.leftCols(1), 10, 1).indices.rows());
  EXPECT_EQ(0.0f, spacingOf(neighbourhoodsOf(points.leftCols(1), 10, 1))[0]);
}

TEST(Neighbourhoods, HoldCopiesOfThePointButNotItself)
{
  Points points = sampled(creature(), 200, 4);
  points.leftCols(40) = points.col(100).replicate(1, 40);
  const Neighbourhoods found = neighbourhoodsOf(points, 10, 1);
  for (Eigen::Index i = 0; i < 40; ++i)
    for (int n = 0; n < 10; ++n) {
      EXPECT_NE(i, found.indices(n, i));
      EXPECT_TRUE(found.indices(n, i) < 40 || found.indices(n, i) == 100);
      EXPECT_EQ(0.0f, found.distances(n, i));
    }
}

TEST(SurfaceVariation, TellsSurfacesFromSpace)
{
  const auto median = [](const Points& points) {
    Eigen::VectorXf values =
        surfaceVariation(points, neighbourhoodsOf(points, 16, 1), 1);
    EXPECT_GE(values.minCoeff(), 0.0f);
    EXPECT_LE(values.maxCoeff(), 1.0f / 3.0f + 1e-5f);
    std::sort(values.data(), values.data() + values.size());
    return values[values.size() / 2];
  };
  EXPECT_LT(median(sampled(pennant(), 800, 5)), 1e-6f);
  EXPECT_LT(median(sampled(lump(), 3000, 6)), 0.02f);
  EXPECT_NEAR(0.16f, median(scattered(3000, 7)), 0.03f);
  EXPECT_EQ(0.0f, median(Points::Constant(3, 50, 2.0f)));
}

TEST(Spacing, IsTheEdgeOfTheSquareThatAPointHas)
{
  // on an even square, and whatever the unit; random points scatter about it
  for (const float unit : {1.0f, 0.01f}) {
    const Points even = unit * square(30);
    const Eigen::VectorXf spacing = spacingOf(neighbourhoodsOf(even, 10, 1));
    EXPECT_NEAR(unit, spacing[15 * 30 + 15], 0.25f * unit);
  }
  const Points random = sampled(panel({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), 10000, 8);
  EXPECT_NEAR(0.01f, spacingOf(neighbourhoodsOf(random, 10, 1)).mean(), 0.0015f);
}

} // namespace
