/*
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * What a cloud's frame and extent go by, and what single precision can hold of it.
 */

#include "clouds.h"

#include <pcl/registration/kss/detail/cloud_conversion.h>

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace {

using namespace kss_test;
using namespace pcl::kss;
using Cloud = pcl::PointCloud<pcl::PointXYZ>;

/** So many points at a distance, each in another direction. */
void
addFar(Cloud& cloud, int number, float distance)
{
  std::mt19937 random(number);
  for (int i = 0; i < number; ++i) {
    const Eigen::Vector3f at = randomVector(random, 1.0).normalized().cast<float>();
    cloud.push_back({distance * at.x(), distance * at.y(), distance * at.z()});
  }
}

UsablePoints<pcl::index_t>
usable(const Cloud& cloud)
{
  return usablePointsOf(cloud, allIndices(cloud));
}

TEST(ToIndex, IsInsideTheGridWhateverTheCoordinate)
{
  const float infinity = std::numeric_limits<float>::infinity();
  for (const int last : {0, 1, 9, 1 << 20, std::numeric_limits<int>::max()}) {
    EXPECT_EQ(0, toIndex(std::nanf(""), last));
    EXPECT_EQ(0, toIndex(-infinity, last));
    EXPECT_EQ(0, toIndex(-1e30f, last));
    EXPECT_EQ(0, toIndex(0.99f, last));
    EXPECT_EQ(last, toIndex(infinity, last));
    EXPECT_EQ(last, toIndex(1e30, last));
  }
  EXPECT_EQ(3, toIndex(3.99, 9));
  EXPECT_EQ(9, toIndex(9.0f, 9));
  EXPECT_EQ(
      Eigen::Vector3i(0, 2, 4),
      toIndices(Eigen::Vector3f(-1.0f, 2.5f, 7.0f), Eigen::Vector3i(4, 4, 4)).matrix());
  EXPECT_EQ(std::size_t(1) << 33, numberOfCells(Eigen::Array3i::Constant(1 << 11)));
}

TEST(Bulk, IsWhereMostPointsAreWhateverAFewAre)
{
  const auto cloud = cloudOf<pcl::PointXYZ>(sampled(creature(), 10000, 1));
  const auto before = usable(*cloud);
  EXPECT_EQ(0, before.far);
  EXPECT_EQ(allIndices(*cloud), before.indices);
  for (const float distance : {1e5f, 1e7f, 1e12f, 1e20f, 1e38f}) {
    Cloud with_far = *cloud;
    addFar(with_far, 5, distance);
    const auto after = usable(with_far);
    EXPECT_EQ(5, after.far);
    EXPECT_EQ(before.indices, after.indices);
    EXPECT_LT((after.bulk.middle - before.bulk.middle).norm(), 0.1);
    EXPECT_NEAR(before.bulk.radius, after.bulk.radius, 0.1);
    EXPECT_LT(toLocalCloud(with_far, after).points.cwiseAbs().maxCoeff(), 10.0f);
  }
}

TEST(Bulk, CountsCopiesOnce)
{
  // more returns that never were than others, in a frame that is far away
  Cloud cloud = *cloudOf<pcl::PointXYZ>(sampled(creature(), 1000, 2).array() + 1e6f);
  for (int i = 0; i < 1500; ++i)
    cloud.push_back({0.0f, 0.0f, 0.0f});
  const auto points = usable(cloud);
  EXPECT_EQ(1500, points.far);
  EXPECT_EQ(1000, points.indices.size());
}

TEST(Bulk, HoldsScansWithFarReturns)
{
  // as dense as the inverse square of the distance, out to some hundred times as far
  // as most returns
  std::mt19937 random(3);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  Cloud scan;
  for (int i = 0; i < 20000; ++i)
    addFar(scan, 1, static_cast<float>(1.0 / (1.0 - 0.999 * share(random))));
  EXPECT_EQ(0, usable(scan).far);
}

TEST(Bulk, SkipsPointsThatAreNotFinite)
{
  Cloud cloud = *cloudOf<pcl::PointXYZ>(sampled(creature(), 300, 4));
  for (std::size_t i = 0; i < 200; ++i)
    makeNaN(cloud[i]);
  EXPECT_EQ(100, usable(cloud).indices.size());
  EXPECT_EQ(0, usable(cloud).far);
  for (pcl::PointXYZ& point : cloud)
    makeNaN(point);
  EXPECT_THROW(usable(cloud), std::invalid_argument);
}

TEST(Bulk, RefusesWhatSinglePrecisionCannotSquare)
{
  const Points points = sampled(creature(), 300, 5);
  for (const float size : {1e-38f, 1e-30f, 1e-15f, 1e15f, 1e30f, 1e38f})
    EXPECT_THROW(usable(*cloudOf<pcl::PointXYZ>(size * points)), std::invalid_argument)
        << size;
  for (const float size : {1e-11f, 1e-6f, 1.0f, 1e6f, 1e11f})
    EXPECT_EQ(0, usable(*cloudOf<pcl::PointXYZ>(size * points)).far) << size;
  // a size that is nothing is for others to judge
  EXPECT_NO_THROW(usable(*cloudOf<pcl::PointXYZ>(Points::Constant(3, 10, 1e30f))));
}

TEST(SortInSpace, KeepsAllPointsWhateverTheExtent)
{
  for (const float size : {1e-40f, 1.0f, 1e30f, 3e38f}) {
    const auto cloud = cloudOf<pcl::PointXYZ>(size * scattered(500, 6));
    pcl::Indices sorted = allIndices(*cloud);
    sortInSpace(placesOf(*cloud), sorted);
    EXPECT_EQ(500, std::set<pcl::index_t>(sorted.begin(), sorted.end()).size());
  }
}

} // namespace
