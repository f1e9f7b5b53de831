/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "poses.h"

#include "geometry/pose_metric.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace {

using namespace kss_test;
using pcl::kss::DistinctPoses;
using pcl::kss::PoseMetric;
using pcl::kss::Similarity;

Points
centred(const Points& points)
{
  const Eigen::Vector3f center = points.rowwise().mean();
  return points.colwise() - center;
}

/** Root mean square, of the placed points. */
double
apart(const Points& cloud, const Eigen::Matrix4d& a, const Eigen::Matrix4d& b)
{
  const Eigen::Matrix3Xd moved =
      (a - b).topRows<3>() * cloud.cast<double>().colwise().homogeneous();
  return std::sqrt(moved.squaredNorm() / cloud.cols());
}

/** A similarity hardly different from another. */
Eigen::Matrix4d
besides(const Eigen::Matrix4d& pose, double distance, unsigned int seed)
{
  std::mt19937 random(seed);
  const Eigen::Quaterniond turned(
      Eigen::AngleAxisd(distance, randomVector(random, 1.0).normalized()));
  return similarity(turned, 1.0 + distance, randomVector(random, distance)) * pose;
}

TEST(PoseMetric, IsTheDistanceOfThePlacedPoints)
{
  Points line(3, 50);
  for (Eigen::Index i = 0; i < 50; ++i)
    line.col(i) = Eigen::Vector3f(1.0f, 2.0f, -1.0f) * static_cast<float>(i) / 50.0f;
  for (const Points& points :
       {sampled(creature(), 500, 1), scattered(100, 2), sampled(pennant(), 300, 3),
        line, Points(Points::Random(3, 1))}) {
    const Points cloud = centred(points);
    const double size = std::sqrt(cloud.squaredNorm() / cloud.cols());
    const PoseMetric metric(cloud);
    for (unsigned int seed = 0; seed < 20; ++seed) {
      const Eigen::Matrix4d a = randomSimilarity(2 * seed);
      const Eigen::Matrix4d b = randomSimilarity(2 * seed + 1);
      // what makes a flat cloud's scatter have a factor is a thousandth of its size
      const double tolerance = 1e-5 * (1.0 + apart(cloud, a, b)) + 1e-3 * size;
      EXPECT_NEAR(apart(cloud, a, b),
                  metric.distance(Similarity::of(a), Similarity::of(b)), tolerance);
      EXPECT_EQ(metric.distance(Similarity::of(a), Similarity::of(b)),
                metric.distance(Similarity::of(b), Similarity::of(a)));
      EXPECT_EQ(0.0, metric.distance(Similarity::of(a), Similarity::of(a)));
      const Eigen::Matrix4d c = besides(a, 0.02, seed);
      EXPECT_NEAR(apart(cloud, a, c),
                  metric.distance(Similarity::of(a), Similarity::of(c)),
                  0.001 * apart(cloud, a, c) + 1e-3 * size * 0.1 + 1e-5);
    }
  }
}

TEST(PoseMetric, IsAlwaysThere)
{
  // all points in one place: what is left is the way that the place goes
  const PoseMetric metric(Points::Zero(3, 10));
  const Eigen::Matrix4d here =
      similarity(Eigen::Quaterniond::Identity(), 1.0, {0, 0, 0});
  const Eigen::Matrix4d there =
      similarity(Eigen::Quaterniond::Identity(), 2.0, {3, 4, 0});
  EXPECT_NEAR(5.0, metric.distance(Similarity::of(here), Similarity::of(there)), 1e-5);
}

TEST(DistinctPoses, AreThoseThatNoneBeforeIsCloseTo)
{
  const Points cloud = centred(sampled(creature(), 300, 4));
  const PoseMetric metric(cloud);
  // fifty places, and eight poses about each
  std::vector<Eigen::Matrix4d> poses;
  for (unsigned int seed = 0; seed < 400; ++seed)
    poses.push_back(besides(randomSimilarity(seed % 50), 0.01 * (seed / 50), seed));
  for (const double distance : {0.0, 0.05, 0.2, 1.0, 100.0}) {
    DistinctPoses distinct(metric, distance);
    std::vector<Eigen::Matrix4d> taken;
    for (const Eigen::Matrix4d& pose : poses) {
      // none is so near the limit that rounding decides
      const bool is_new =
          std::none_of(taken.begin(), taken.end(), [&](const Eigen::Matrix4d& other) {
            return metric.distance(Similarity::of(pose), Similarity::of(other)) <
                   distance;
          });
      ASSERT_EQ(is_new, distinct.take(Similarity::of(pose))) << distance;
      if (is_new)
        taken.push_back(pose);
      ASSERT_EQ(taken.size(), distinct.size());
      if (distance > 0.0) {
        ASSERT_FALSE(distinct.take(Similarity::of(pose)));
      }
    }
    if (distance == 0.0) {
      EXPECT_EQ(poses.size(), distinct.size());
    }
    else if (distance == 100.0) {
      EXPECT_EQ(1u, distinct.size());
    }
    else {
      EXPECT_GT(distinct.size(), 25u);
      if (distance > 0.1) {
        EXPECT_LT(distinct.size(), poses.size());
      }
    }
  }
}

} // namespace
