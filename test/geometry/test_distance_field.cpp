/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "poses.h"

#include "geometry/distance_field.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <set>
#include <vector>

namespace {

using namespace kss_test;
using namespace pcl::kss;

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

/** Of how many half diagonals the distance of a cell is too long, at its centre. */
double
longestError(const Points& cloud, float cell, float margin)
{
  const DistanceField field(cloud, cell, margin);
  const double edge = 1.0 / field.inverseEdge(), half = 0.5 * std::sqrt(3.0) * edge;
  double longest = 0.0;
  for (std::size_t i = 0; i < field.distances().size(); ++i) {
    const Eigen::Vector3i at(i % field.size().x(),
                             i / field.size().x() % field.size().y(),
                             i / field.size().x() / field.size().y());
    const Eigen::Vector3f center =
        field.lower() +
        (edge * (at.cast<double>().array() + 0.5)).matrix().cast<float>();
    const auto distances = (cloud.colwise() - center).colwise().norm();
    const double nearest = distances.minCoeff(), found = field.distances()[i];
    const double rounding = 1e-5 * (1.0 + nearest);
    EXPECT_NEAR((cloud.col(field.nearest(i)) - center).norm(), found, rounding);
    EXPECT_GE(found, nearest - rounding);
    EXPECT_LE(found,
              std::sqrt(3.0) * nearest + (1.0 + std::sqrt(3.0)) * half + rounding);
    longest = std::max(longest, (found - nearest) / half);
  }
  return longest;
}

TEST(DistanceField, KnowsPointsThatAreAsNearAsItSays)
{
  double longest = 0.0;
  for (unsigned int seed = 0; seed < 60 && !::testing::Test::HasFailure(); ++seed) {
    // few points, in clusters or not: most of the cells are far from any
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> coordinate(0.0f, 1.0f);
    Points cloud(3, 1 + random() % 40);
    for (float& value : cloud.reshaped())
      value = coordinate(random);
    if (seed % 3 == 1)
      cloud.row(2) *= 0.01f;
    if (seed % 3 == 2)
      cloud = (3.0f * cloud).array().floor() / 3.0f + 0.08f * cloud.array();
    longest = std::max(longest, longestError(cloud, 0.03f + 0.1f * coordinate(random),
                                             seed % 2 ? 0.3f : 1.0f));
  }
  // not all of them are the nearest, nor within half a diagonal of it
  EXPECT_GT(longest, 1.0);
}

} // namespace
