/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "shapes.h"

#include "preparation/farthest_points.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

namespace {

using namespace kss_test;
using pcl::kss::FarthestOrder;
using pcl::kss::inFarthestOrder;

/** Each point is the farthest from those before it, by the definition; which one, where
 * several are equally far, is free. */
void
expectFarthest(const FarthestOrder& order, const Points& cloud, Eigen::Index most)
{
  const Eigen::Index size = std::min(most, cloud.cols());
  ASSERT_EQ(static_cast<std::size_t>(size), order.indices.size());
  ASSERT_EQ(order.indices.size(), order.gaps.size());
  const Eigen::Vector3d middle = cloud.cast<double>().rowwise().mean();
  const Eigen::RowVectorXd from_middle =
      (cloud.cast<double>().colwise() - middle).colwise().norm();
  EXPECT_LE(from_middle[order.indices.front()],
            from_middle.minCoeff() + 1e-5 * (1.0 + cloud.cwiseAbs().maxCoeff()));
  EXPECT_EQ(std::numeric_limits<float>::infinity(), order.gaps.front());
  EXPECT_EQ(order.indices.size(),
            std::set<int>(order.indices.begin(), order.indices.end()).size());

  Eigen::RowVectorXf squared =
      Eigen::RowVectorXf::Constant(cloud.cols(), std::numeric_limits<float>::max());
  for (Eigen::Index i = 0; i < size; ++i) {
    const int sample = order.indices[i];
    ASSERT_TRUE(sample >= 0 && sample < cloud.cols());
    if (i > 0) {
      ASSERT_FLOAT_EQ(std::sqrt(squared.maxCoeff()), order.gaps[i]) << i;
      ASSERT_FLOAT_EQ(order.gaps[i], std::sqrt(squared[sample])) << i;
      ASSERT_LE(order.gaps[i], order.gaps[i - 1]) << i;
    }
    const Eigen::Vector3f position = cloud.col(sample);
    squared = squared.cwiseMin((cloud.colwise() - position).colwise().squaredNorm());
    squared[sample] = -1.0f;
  }
}

/** Points whose density falls off exponentially along all axes. */
Points
uneven(Eigen::Index number, unsigned int seed)
{
  return (scattered(number, seed).array() * 8.0f).exp();
}

Points
line(Eigen::Index number)
{
  Points points(3, number);
  for (Eigen::Index i = 0; i < number; ++i)
    points.col(i) = Eigen::Vector3f(1.0f, 2.0f, -1.0f) * static_cast<float>(i);
  return points;
}

TEST(FarthestOrder, IsThatOfFarthestPointSampling)
{
  for (const Points& cloud :
       {sampled(creature(), 3000, 1), sampled(pennant(), 2000, 2), scattered(2000, 3),
        uneven(3000, 4), noisy(sampled(lump(), 2000, 5), 0.05, 6)})
    for (const Eigen::Index most : {1, 2, 100, 1000})
      expectFarthest(inFarthestOrder(cloud, most), cloud, most);
}

TEST(FarthestOrder, HoldsAllPointsWhereThereAreNoMore)
{
  for (const Eigen::Index size : {1, 2, 3, 47, 48, 49, 500}) {
    const Points cloud = scattered(size, 7);
    for (const Eigen::Index most : {size, size + 1, 10 * size})
      expectFarthest(inFarthestOrder(cloud, most), cloud, most);
  }
}

TEST(FarthestOrder, IsRightWherePointsAreEquallyFar)
{
  const Points once = scattered(300, 8);
  Points thrice(3, 900);
  thrice << once, once, once;
  Points lattice(3, 1000);
  for (int i = 0; i < 1000; ++i)
    lattice.col(i) = Eigen::Vector3f(i % 10, i / 10 % 10, i / 100);
  for (const Points& cloud :
       {thrice, lattice, line(2000), Points(Points::Constant(3, 500, 2.5f))})
    for (const Eigen::Index most : {Eigen::Index(100), cloud.cols()})
      expectFarthest(inFarthestOrder(cloud, most), cloud, most);
  // copies come last
  const FarthestOrder order = inFarthestOrder(thrice, 900);
  EXPECT_GT(order.gaps[299], 0.0f);
  EXPECT_EQ(0.0f, order.gaps[300]);
}

TEST(FarthestOrder, IsRightNearAStrayPoint)
{
  for (const float distance : {1e2f, 1e5f, 1e7f})
    for (const float side : {-1.0f, 1.0f}) {
      Points cloud = sampled(creature(), 3000, 9);
      cloud.col(17).setConstant(side * distance);
      expectFarthest(inFarthestOrder(cloud, 400), cloud, 400);
    }
}

TEST(FarthestOrder, DoesNotDependOnTheUnit)
{
  // a power of two scales floats without rounding
  const Points cloud = sampled(creature(), 3000, 10);
  const FarthestOrder order = inFarthestOrder(cloud, 500);
  for (const float unit : {0x1p-20f, 0x1p20f}) {
    const FarthestOrder other = inFarthestOrder(cloud * unit, 500);
    EXPECT_EQ(order.indices, other.indices);
    for (std::size_t i = 1; i < order.gaps.size(); ++i)
      EXPECT_EQ(order.gaps[i] * unit, other.gaps[i]);
  }
}

} // namespace
