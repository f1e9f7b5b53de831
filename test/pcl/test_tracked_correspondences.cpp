/*
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * What the final ICP works with: correspondences, and which points take part.
 */

#include "clouds.h"

#include <pcl/common/transforms.h>
#include <pcl/registration/kss/detail/cloud_conversion.h>
#include <pcl/registration/kss/detail/tracked_correspondences.h>

#include <gtest/gtest.h>

#include <limits>
#include <set>

namespace {

using namespace kss_test;
using Cloud = pcl::PointCloud<pcl::PointXYZ>;
using Reference =
    pcl::registration::CorrespondenceEstimation<pcl::PointXYZ, pcl::PointXYZ, float>;
using Tracked = pcl::kss::TrackedCorrespondences<pcl::PointXYZ, pcl::PointXYZ, float>;

constexpr double no_limit = std::numeric_limits<double>::max();

/** Both find the same; a point that is as near as another within rounding aside. */
void
expectSame(Reference& reference, Tracked& tracked, double max_distance)
{
  pcl::Correspondences expected, found;
  reference.determineCorrespondences(expected, max_distance);
  tracked.determineCorrespondences(found, max_distance);
  ASSERT_EQ(expected.size(), found.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    ASSERT_EQ(expected[i].index_query, found[i].index_query);
    ASSERT_EQ(expected[i].index_match, found[i].index_match) << i;
    ASSERT_FLOAT_EQ(expected[i].distance, found[i].distance) << i;
  }
}

/** Moves as ICP makes them: far, then less and less, and far again. */
const double moves[] = {1.0,  0.3,  0.1,  0.05, 0.02, 0.01, 3e-3, 1e-3, 3e-4,
                        1e-4, 1e-5, 1e-6, 0.0,  0.5,  0.03, 1e-3, 1e-3, 1e-3};

void
move(Cloud& cloud, double distance, unsigned int seed)
{
  std::mt19937 random(seed);
  const Eigen::Quaterniond turned(
      Eigen::AngleAxisd(distance, randomVector(random, 1.0).normalized()));
  const Eigen::Matrix4d step =
      similarity(turned, 1.0 + 0.1 * distance, randomVector(random, distance));
  pcl::transformPointCloud(cloud, cloud, Eigen::Matrix4f(step.cast<float>()));
}

class TrackedCorrespondences : public ::testing::Test {
protected:
  TrackedCorrespondences()
  {
    setTarget(cloudOf<pcl::PointXYZ>(sampled(creature(), 1500, 1)));
    setSource(cloudOf<pcl::PointXYZ>(sampled(creature(), 1000, 2)));
  }

  void
  setSource(const Cloud::Ptr& cloud)
  {
    source_ = cloud;
    reference_.setInputSource(cloud);
    tracked_.setInputSource(cloud);
  }

  void
  setTarget(const Cloud::Ptr& cloud)
  {
    target_ = cloud;
    reference_.setInputTarget(cloud);
    tracked_.setInputTarget(cloud);
  }

  /** As many moves as there are, and the same correspondences after each. */
  void
  expectSameAllAlong(double max_distance = no_limit)
  {
    unsigned int seed = 3;
    for (const double distance : moves) {
      move(*source_, distance, seed++);
      SCOPED_TRACE(distance);
      expectSame(reference_, tracked_, max_distance);
      if (HasFatalFailure())
        return;
    }
  }

  Cloud::Ptr source_, target_;
  Reference reference_;
  Tracked tracked_;
};

TEST_F(TrackedCorrespondences, AreThoseOfPCL)
{
  expectSameAllAlong();
}

TEST_F(TrackedCorrespondences, AreNoLongerThanAskedFor)
{
  expectSameAllAlong(0.1);
  expectSameAllAlong(0.01);
  // another limit each time
  for (const double limit : {1.0, 0.02, 0.3, no_limit, 0.0, 0.1})
    expectSame(reference_, tracked_, limit);
}

TEST_F(TrackedCorrespondences, FollowsAnotherTarget)
{
  expectSameAllAlong();
  // of the same size, so that nothing but the cloud tells
  setTarget(cloudOf<pcl::PointXYZ>(sampled(lump(), 1500, 4)));
  expectSame(reference_, tracked_, no_limit);
  expectSameAllAlong();
  setTarget(cloudOf<pcl::PointXYZ>(sampled(cross(), 30, 5)));
  expectSame(reference_, tracked_, no_limit);
}

TEST_F(TrackedCorrespondences, FollowsATargetThatHasChanged)
{
  // as pcl::Registration does: the tree is built anew, then handed on
  const auto tree = pcl::make_shared<pcl::search::KdTree<pcl::PointXYZ>>();
  tree->setInputCloud(target_);
  tracked_.setSearchMethodTarget(tree);
  expectSame(reference_, tracked_, no_limit);
  *target_ = *cloudOf<pcl::PointXYZ>(sampled(lump(), 1500, 6));
  tree->setInputCloud(target_);
  tracked_.reset();
  setTarget(target_);
  expectSame(reference_, tracked_, no_limit);
  expectSameAllAlong();
}

TEST_F(TrackedCorrespondences, FollowsAnotherSource)
{
  expectSameAllAlong();
  setSource(cloudOf<pcl::PointXYZ>(sampled(cross(), 1000, 7)));
  expectSame(reference_, tracked_, no_limit);
  setSource(cloudOf<pcl::PointXYZ>(sampled(creature(), 300, 8)));
  expectSameAllAlong();
  setSource(cloudOf<pcl::PointXYZ>(sampled(creature(), 2000, 9)));
  expectSameAllAlong();
}

TEST_F(TrackedCorrespondences, KnowsIndices)
{
  expectSame(reference_, tracked_, no_limit);
  const auto some = pcl::make_shared<pcl::Indices>();
  for (int i = 999; i > 0; i -= 3)
    some->push_back(i);
  reference_.setIndicesSource(some);
  tracked_.setIndicesSource(some);
  expectSameAllAlong(0.2);
  // and of the target
  reference_.setIndicesTarget(some);
  tracked_.setIndicesTarget(some);
  expectSameAllAlong();
}

TEST_F(TrackedCorrespondences, WorksForTargetsOfFewPoints)
{
  for (const int number : {1, 2, 3}) {
    setTarget(cloudOf<pcl::PointXYZ>(scattered(number, 10)));
    expectSameAllAlong();
  }
}

TEST_F(TrackedCorrespondences, CanBeCloned)
{
  expectSame(reference_, tracked_, no_limit);
  const auto clone = tracked_.clone();
  ASSERT_NE(nullptr, clone);
  move(*source_, 1e-3, 11);
  auto& tracked_clone = dynamic_cast<Tracked&>(*clone);
  expectSame(reference_, tracked_clone, no_limit);
  // each goes its own way
  setTarget(cloudOf<pcl::PointXYZ>(sampled(lump(), 1500, 12)));
  expectSame(reference_, tracked_, no_limit);
}

TEST(Spread, TakesSoManyIndicesAllOver)
{
  pcl::Indices indices(10000);
  for (std::size_t i = 0; i < indices.size(); ++i)
    indices[i] = static_cast<pcl::index_t>(3 * i + 7);
  for (const std::size_t most : {1u, 2u, 7u, 500u, 3333u, 5000u, 9999u}) {
    const pcl::Indices some = pcl::kss::spread(indices, most);
    ASSERT_EQ(most, some.size());
    EXPECT_EQ(most, std::set<pcl::index_t>(some.begin(), some.end()).size());
    EXPECT_TRUE(std::is_sorted(some.begin(), some.end()));
    for (std::size_t i = 0; i < most; ++i) {
      // one of each stretch
      ASSERT_EQ(1, (some[i] - 7) % 3 == 0);
      const auto place = static_cast<std::size_t>(some[i] - 7) / 3;
      EXPECT_GE((place + 1) * most, i * indices.size());
      EXPECT_LE(place * most, (i + 1) * indices.size());
    }
  }
}

TEST(Spread, TakesAllWhereThereAreNoMore)
{
  const pcl::Indices indices{5, 2, 9, 9, 1};
  for (const std::size_t most : {0u, 5u, 6u, 1000u})
    EXPECT_EQ(indices, pcl::kss::spread(indices, most));
  EXPECT_TRUE(pcl::kss::spread(pcl::Indices(), 0).empty());
  EXPECT_TRUE(pcl::kss::spread(pcl::Indices(), 10).empty());
}

TEST(Spread, TakesNoColumnOfAnImageAlone)
{
  // 640 x 480, and so many that a plain step would be two rows
  pcl::Indices indices(640 * 480);
  for (std::size_t i = 0; i < indices.size(); ++i)
    indices[i] = static_cast<pcl::index_t>(i);
  std::vector<int> columns(8);
  for (const pcl::index_t i : pcl::kss::spread(indices, 240))
    ++columns[i % 640 / 80];
  for (const int number : columns)
    EXPECT_NEAR(30, number, 10);
}

} // namespace
