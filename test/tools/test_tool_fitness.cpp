/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "command_line/fitness.h"
#include "command_line/registration.h"
#include "io/mesh_sampling.h"

#include <pcl/kdtree/kdtree_flann.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

using namespace tool;

namespace {

constexpr std::size_t many = 3 * FITNESS_POINTS;

/** Points of a surface, from its lower end to its upper one, as scanners store them,
 * with noise that grows on the way: no part of the rows stands for the whole. */
SurfacePoints
scan(unsigned int seed, double noise)
{
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  SurfacePoints scan;
  for (std::size_t i = 0; i < many; ++i) {
    Eigen::Vector3d p(normal(random), normal(random), normal(random));
    p.normalize();
    p *= 1.0 + 0.5 * p.x() * p.y() + 0.4 * std::pow(p.z(), 3) + 0.3 * p.x();
    scan.positions.push_back(p);
  }
  std::sort(scan.positions.begin(), scan.positions.end(),
            [](const auto& a, const auto& b) { return a.z() < b.z(); });
  for (std::size_t i = 0; i < many; ++i)
    for (double& coordinate : scan.positions[i])
      coordinate += noise * i / many * normal(random);
  return scan;
}

/** The mean squared distance of all points from the nearest ones. */
double
ofAllPoints(const Points& points, const Points& others, const Eigen::Matrix4d& pose)
{
  const auto cloud = pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  const auto as_floats = [](const Eigen::Vector3d& p) {
    const Eigen::Vector3f f = p.cast<float>();
    return pcl::PointXYZ(f.x(), f.y(), f.z());
  };
  for (const auto& other : others)
    cloud->push_back(as_floats(other));
  pcl::KdTreeFLANN<pcl::PointXYZ> tree;
  tree.setInputCloud(cloud);
  double sum = 0.0;
  pcl::Indices nearest(1);
  std::vector<float> squared(1);
  for (const auto& point : points) {
    tree.nearestKSearch(as_floats((pose * point.homogeneous()).head<3>()), 1, nearest,
                        squared);
    sum += squared[0];
  }
  return sum / points.size();
}

Result
quickly(const SurfacePoints& source, const SurfacePoints& target, bool with_fitness)
{
  pcl::kss::Settings settings;
  settings.estimate_scale = false;
  settings.sample_points = 300;
  settings.device = "host";
  return registerClouds(cloudOf(source), cloudOf(target), settings, {}, 0,
                        with_fitness);
}

} // namespace

TEST(ToolFitness, OfSomePointsIsThatOfAll)
{
  SurfacePoints source = scan(1, 0.05);
  const SurfacePoints target = scan(2, 0.0);
  const Result result = quickly(source, target, true);
  ASSERT_TRUE(result.converged) << result.reason;
  ASSERT_TRUE(result.fitness.has_value());
  const double all = ofAllPoints(source.positions, target.positions,
                                 result.poses.front().transformation);
  EXPECT_NEAR(all, *result.fitness, 0.03 * all);
  // the first rows would say something else
  const Points first(source.positions.begin(),
                     source.positions.begin() + FITNESS_POINTS);
  EXPECT_GT(0.5 * all,
            ofAllPoints(first, target.positions, result.poses.front().transformation));
}

TEST(ToolFitness, OfFewPointsIsExact)
{
  SurfacePoints source = scan(1, 0.05);
  const SurfacePoints target = scan(2, 0.0);
  Points few;
  for (std::size_t i = 0; i < many; i += many / FITNESS_POINTS)
    few.push_back(source.positions[i]);
  ASSERT_EQ(FITNESS_POINTS, few.size());
  source.positions = few;
  source.positions.insert(source.positions.begin() + few.size() / 2,
                          Eigen::Vector3d::Constant(std::nan("")));
  const Result result = quickly(source, target, true);
  ASSERT_TRUE(result.fitness.has_value());
  const double all =
      ofAllPoints(few, target.positions, result.poses.front().transformation);
  EXPECT_NEAR(all, *result.fitness, 1e-4 * all);
}

TEST(ToolFitness, IsNotFoundUnlessAskedFor)
{
  const SurfacePoints source = scan(1, 0.0), target = scan(2, 0.0);
  const Result result = quickly(source, target, false);
  EXPECT_TRUE(result.converged) << result.reason;
  EXPECT_FALSE(result.fitness.has_value());
}
