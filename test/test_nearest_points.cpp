/*
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * Neighbourhoods, distance fields and nearest points: all against brute force.
 */

#include "poses.h"

#include <pcl/registration/kss/distance_field.h>
#include <pcl/registration/kss/nearest_points.h>
#include <pcl/registration/kss/neighbourhoods.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace {

using namespace kss_test;
using namespace pcl::kss;

float
distanceTo(const Points& points, const Eigen::Vector3f& position)
{
  return std::sqrt((points.colwise() - position).colwise().squaredNorm().minCoeff());
}

/** Even points of a square, a unit apart. */
Points
square(int edge)
{
  Points points(3, edge * edge);
  for (int i = 0; i < edge * edge; ++i)
    points.col(i) = Eigen::Vector3f(i % edge, i / edge, 0.0f);
  return points;
}

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

TEST(DistanceField, KnowsTheNearestPointOfNearlyEveryCell)
{
  for (const Points& points :
       {sampled(creature(), 400, 9), scattered(100, 10), Points(scattered(2, 11))}) {
    const float cell = 0.08f, margin = 0.3f;
    const DistanceField field(points, cell, margin);
    EXPECT_FLOAT_EQ(1.0f / cell, field.inverseEdge());
    // it holds all points, and the margin
    const Eigen::Vector3f upper =
        field.lower() + field.size().cast<float>() / field.inverseEdge();
    EXPECT_LT((points.rowwise().minCoeff() - field.lower()).array().abs().maxCoeff(),
              margin + 1e-4f);
    EXPECT_GE((upper - points.rowwise().maxCoeff()).minCoeff(), margin - 1e-4f);
    ASSERT_EQ(static_cast<std::size_t>(field.size().prod()), field.distances().size());

    std::size_t missed = 0, missed_widely = 0, index = 0;
    float worst = 0.0f;
    for (int z = 0; z < field.size().z(); ++z)
      for (int y = 0; y < field.size().y(); ++y)
        for (int x = 0; x < field.size().x(); ++x, ++index) {
          const Eigen::Vector3f center =
              field.lower() + cell * Eigen::Vector3f(x + 0.5f, y + 0.5f, z + 0.5f);
          ASSERT_EQ(index, field.cellOf(center));
          const float expected = distanceTo(points, center);
          const float found = field.distances()[index];
          // never nearer than the nearest, and always that of the point it names
          ASSERT_GE(found, expected - 1e-5f);
          ASSERT_NEAR((points.col(field.nearest(index)) - center).norm(), found, 1e-5f);
          missed += found > expected + 1e-5f;
          missed_widely += found > expected + 0.1f * cell;
          worst = std::max(worst, found - expected);
        }
    // by how much it is missed is what counts: not at all in most cells, a tenth of a
    // cell in nearly all, never a whole cell
    EXPECT_LT(missed, 0.15 * index);
    EXPECT_LT(missed_widely, 0.06 * index);
    EXPECT_LT(worst, cell);
  }
}

TEST(DistanceField, GivesItsBorderToWhatLiesBeyond)
{
  const Points points = sampled(creature(), 300, 12);
  const DistanceField field(points, 0.1f, 0.2f);
  const Eigen::Vector3f upper =
      field.lower() + field.size().cast<float>() / field.inverseEdge();
  EXPECT_EQ(0u, field.cellOf(field.lower() - Eigen::Vector3f(5.0f, 3.0f, 0.2f)));
  EXPECT_EQ(field.distances().size() - 1,
            field.cellOf(upper + Eigen::Vector3f(1e6f, 0.1f, 70.0f)));
  const Eigen::Vector3f middle = 0.5f * (field.lower() + upper);
  Eigen::Vector3f left = middle, far_left = middle;
  left.x() = field.lower().x() + 0.05f;
  far_left.x() = -1000.0f;
  EXPECT_EQ(field.cellOf(left), field.cellOf(far_left));
}

TEST(DistanceField, HasNoMoreThanFourMillionCells)
{
  const DistanceField field(sampled(pennant(), 100, 13), 1e-3f, 0.5f);
  EXPECT_LE(field.distances().size(), 4000000u);
  EXPECT_GT(field.distances().size(), 1000000u);
  // a point, a row, a plane
  for (const Points& points : {Points(Points::Constant(3, 1, 2.0f)),
                               Points(square(5).leftCols(5)), square(5)}) {
    const DistanceField flat(points, 0.5f, 1.0f);
    const Eigen::Vector3f position = points.col(0) + Eigen::Vector3f(0, 0, 0.3f);
    EXPECT_NEAR(0.3f, flat.distances()[flat.cellOf(position)], 0.45f);
  }
}

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

TEST(NearestPoints, KnowTheSpacing)
{
  const Points points = sampled(creature(), 2000, 22);
  const NearestPoints search(points, 2);
  EXPECT_EQ(spacingOf(neighbourhoodsOf(points, 10, 1)), search.spacing());
}

} // namespace
