/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "clouds.h"

#include <pcl/registration/kss/detail/packed_search.h>
#include <pcl/registration/kss/detail/packed_tree.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace {

using namespace kss_test;
using pcl::kss::NearestTwo;
using pcl::kss::PackedTree;

constexpr float infinite = std::numeric_limits<float>::infinity();

PackedTree
treeOf(const Points& points)
{
  return PackedTree(points.data(), 3, points.cols());
}

NearestTwo
byBruteForce(const Points& points, const Eigen::Vector3f& position, float squared_limit)
{
  NearestTwo two;
  for (int i = 0; i < points.cols(); ++i) {
    const float squared = (points.col(i) - position).squaredNorm();
    if (!(squared <= squared_limit))
      continue;
    if (squared < two.squared) {
      two.second = two.nearest;
      two.second_squared = two.squared;
      two.nearest = i;
      two.squared = squared;
    }
    else if (squared < two.second_squared) {
      two.second = i;
      two.second_squared = squared;
    }
  }
  return two;
}

void
expectSame(const Points& points, const Points& positions, float squared_limit)
{
  const PackedTree tree = treeOf(points);
  for (Eigen::Index i = 0; i < positions.cols(); ++i) {
    const Eigen::Vector3f position = positions.col(i);
    const NearestTwo expected = byBruteForce(points, position, squared_limit);
    const NearestTwo found = tree.nearest(position.data(), squared_limit);
    ASSERT_EQ(expected.nearest, found.nearest) << i;
    ASSERT_EQ(expected.second, found.second) << i;
    // infinite where there is none
    ASSERT_FLOAT_EQ(expected.squared, found.squared) << i;
    ASSERT_FLOAT_EQ(expected.second_squared, found.second_squared) << i;
  }
}

TEST(PackedTree, FindsTheNearestTwo)
{
  // numbers around those of leaves and nodes, and several levels
  for (const int size : {1, 2, 15, 16, 17, 127, 128, 129, 1025, 9000})
    expectSame(sampled(creature(), size, 1), sampled(creature(), 300, 2), infinite);
}

TEST(PackedTree, FindsThemFromAfar)
{
  expectSame(sampled(creature(), 2000, 3), 50.0f * sampled(creature(), 100, 4),
             infinite);
}

TEST(PackedTree, FindsNoneBeyondALimit)
{
  const Points points = sampled(creature(), 3000, 5), positions = scattered(500, 6);
  for (const float limit : {0.0f, 1e-4f, 1e-2f, 0.1f})
    expectSame(points, positions, limit);
  // what lies at the limit is within
  const Points one = Points::Zero(3, 1);
  const float position[] = {3.0f, 4.0f, 0.0f};
  EXPECT_EQ(0, treeOf(one).nearest(position, 25.0f).nearest);
  EXPECT_EQ(-1, treeOf(one).nearest(position, 24.99f).nearest);
}

TEST(PackedTree, KnowsUnevenClouds)
{
  Points points = sampled(creature(), 4000, 7);
  points.leftCols(3000) *= 1e-3f; // most of it in one cell of the curve
  points.col(17).setConstant(1e6f);
  points.row(1).tail(500).setZero();
  expectSame(points, sampled(creature(), 200, 8), infinite);
  expectSame(points, 1e-3f * sampled(creature(), 200, 9), infinite);
}

TEST(PackedTree, LeavesOutWhatIsNotFinite)
{
  Points points = sampled(creature(), 500, 10);
  const Points positions = points;
  points.col(3).setConstant(std::nanf(""));
  points(1, 7) = infinite;
  const PackedTree tree = treeOf(points);
  for (int i = 0; i < points.cols(); ++i) {
    const int nearest = tree.nearest(positions.col(i).data()).nearest;
    EXPECT_EQ(i != 3 && i != 7, nearest == i);
  }
  const float nowhere[] = {std::nanf(""), 0.0f, 0.0f};
  EXPECT_EQ(-1, tree.nearest(nowhere).nearest);
  points.setConstant(infinite);
  EXPECT_EQ(-1, treeOf(points).nearest(positions.col(0).data()).nearest);
}

class PackedSearch : public ::testing::Test {
protected:
  using Cloud = pcl::PointCloud<pcl::PointXYZ>;

  PackedSearch()
  : cloud_(cloudOf<pcl::PointXYZ>(sampled(creature(), 3000, 11)))
  , queries_(cloudOf<pcl::PointXYZ>(sampled(creature(), 200, 12)))
  {
    search_.setInputCloud(cloud_);
    reference_.setInputCloud(cloud_);
  }

  void
  expectSame(int k)
  {
    pcl::Indices expected, found;
    std::vector<float> expected_squared, found_squared;
    for (const pcl::PointXYZ& query : *queries_) {
      const int number =
          reference_.nearestKSearch(query, k, expected, expected_squared);
      ASSERT_EQ(number, search_.nearestKSearch(query, k, found, found_squared));
      ASSERT_EQ(expected, found);
      for (std::size_t i = 0; i < found.size(); ++i)
        ASSERT_FLOAT_EQ(expected_squared[i], found_squared[i]);
      reference_.radiusSearch(query, 0.1, expected, expected_squared);
      search_.radiusSearch(query, 0.1, found, found_squared);
      ASSERT_EQ(expected, found);
    }
  }

  Cloud::Ptr cloud_, queries_;
  pcl::kss::PackedSearch<pcl::PointXYZ> search_;
  pcl::search::KdTree<pcl::PointXYZ> reference_;
};

TEST_F(PackedSearch, FindsWhatPCLFinds)
{
  for (const int k : {1, 2, 3, 20})
    expectSame(k);
}

TEST_F(PackedSearch, FollowsItsCloud)
{
  expectSame(2);
  cloud_ = cloudOf<pcl::PointXYZ>(sampled(lump(), 2000, 13));
  search_.setInputCloud(cloud_);
  reference_.setInputCloud(cloud_);
  expectSame(2);
  expectSame(5);
}

TEST_F(PackedSearch, KnowsIndices)
{
  const auto some = pcl::make_shared<pcl::Indices>();
  for (int i = 2999; i > 0; i -= 7)
    some->push_back(i);
  search_.setInputCloud(cloud_, some);
  reference_.setInputCloud(cloud_, some);
  expectSame(1);
  expectSame(2);
  expectSame(3);
}

TEST_F(PackedSearch, KnowsOtherDistances)
{
  const auto flat =
      pcl::make_shared<pcl::CustomPointRepresentation<pcl::PointXYZ>>(2, 0);
  search_.setPointRepresentation(flat);
  reference_.setPointRepresentation(flat);
  expectSame(1);
  expectSame(2);
}

} // namespace
