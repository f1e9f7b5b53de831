/*
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * KSSICP on real scans: complete objects and those that share enough have to be
 * registered, the others have to be registered or refused. A wrong pose that is called
 * converged is the one thing that must not come out.
 */

#include "pairs.h"

#include <pcl/io/pcd_io.h>

#include <cstdlib>
#include <fstream>

namespace {

using namespace kss_test;
using KSSICP = pcl::KSSICP<pcl::PointXYZ, pcl::PointXYZ>;
using Cloud = pcl::PointCloud<pcl::PointXYZ>;

class RealClouds : public ::testing::Test {
protected:
  void
  SetUp() override
  {
    const char* folder = std::getenv("PCL_KSS_ICP_TEST_DATA");
    if (!folder || !*folder)
      GTEST_SKIP() << "Set PCL_KSS_ICP_TEST_DATA to a folder with real scans.";
    folder_ = std::string(folder) + "/";
  }

  Cloud::Ptr
  load(const std::string& name, std::size_t stride = 1) const
  {
    Cloud all;
    if (pcl::io::loadPCDFile(folder_ + name, all) != 0)
      throw std::runtime_error("cannot read " + folder_ + name);
    const auto thinned = pcl::make_shared<Cloud>();
    for (std::size_t i = 0; i < all.size(); i += stride)
      thinned->push_back(all[i]);
    return thinned;
  }

  Eigen::Matrix4d
  loadPose(const std::string& name) const
  {
    std::ifstream file(folder_ + name);
    Eigen::Matrix4d pose;
    for (int row = 0; row < 4; ++row)
      for (int column = 0; column < 4; ++column)
        file >> pose(row, column);
    if (!file)
      throw std::runtime_error("cannot read " + folder_ + name);
    return pose;
  }

  /** \brief Two scans whose pose is known, the source turned away from it. */
  Pair<>
  turnedPair(const Cloud::Ptr& source,
             const Cloud::Ptr& target,
             const Eigen::Matrix4d& pose,
             unsigned int seed) const
  {
    // a turn that leaves no hint, a shift of the size of the object
    std::mt19937 random(seed);
    const Points points = pointsOf(*source);
    const Eigen::Matrix4d away = similarity(randomRotation(random), 1.0,
                                            randomVector(random, diagonalOf(points)));
    return {cloudOf<pcl::PointXYZ>(transformed(points, away)), target,
            pose * away.inverse()};
  }

  /** \brief Where plain ICP ends that starts at the truth: what is left of its error is
   * in the data (points of one scan repel each other, and parts that only one scan has
   * pull it away), not in the search. */
  Eigen::Matrix4d
  icpFromTruth(const Pair<>& pair) const
  {
    pcl::IterativeClosestPoint<pcl::PointXYZ, pcl::PointXYZ> icp;
    icp.setMaximumIterations(300);
    icp.setEuclideanFitnessEpsilon(1e-5);
    icp.setInputSource(pair.source);
    icp.setInputTarget(pair.target);
    Cloud output;
    icp.align(output, pair.truth.cast<float>());
    return icp.getFinalTransformation().cast<double>();
  }

  /** \brief Whether the claim, if there is one, is true; and it has to be made. */
  void
  expectRight(const Pair<>& pair, const std::string& name) const
  {
    // bun000 and bun270 share too little to be sure
    expectRightOrRefused(pair, name, name != "bun000 on bun270");
  }

  /** \brief Whether the claim, if there is one, is true. */
  void
  expectRightOrRefused(const Pair<>& pair,
                       const std::string& name,
                       bool has_to_converge = false) const
  {
    KSSICP registration;
    set(registration, &pcl::kss::Settings::sample_points, 1000);
    registration.setScaleEstimation(false);
    registration.setInputSource(pair.source);
    registration.setInputTarget(pair.target);
    Cloud output;
    registration.align(output);
    const Points source = pointsOf(*pair.source);
    const Eigen::Matrix4d pose = poseFrom(registration);
    const double off = displacement(pose, pair.truth, source);
    const double turned = rotationErrorDegrees(pose, pair.truth);
    std::cout << name << ": " << (registration.hasConverged() ? "converged" : "refused")
              << ", " << turned << " degrees, " << 100.0 * off
              << " % of the diagonal, overlap " << registration.getOverlap().source
              << " and " << registration.getOverlap().target << ", score "
              << registration.getOverlap().score << '\n';
    if (has_to_converge) {
      EXPECT_TRUE(registration.hasConverged())
          << name << ": " << registration.getFailureReason();
    }
    if (!registration.hasConverged()) {
      EXPECT_FALSE(registration.getFailureReason().empty()) << name;
      return;
    }
    const Eigen::Matrix4d reachable = icpFromTruth(pair);
    EXPECT_LT(std::min(turned, rotationErrorDegrees(pose, reachable)), 5.0)
        << name << " was called converged";
    EXPECT_LT(off, 0.05) << name << " was called converged";
  }

  std::string folder_;
};

TEST_F(RealClouds, CompleteObjectsAreRegistered)
{
  unsigned int seed = 1;
  for (const char* name : {"kitten_points", "oni_points"})
    for (int round = 0; round < 2; ++round, ++seed) {
      // Halves that share no point, as two scans would not.
      const auto all = load(std::string("objects/") + name + ".pcd");
      std::mt19937 random(seed);
      std::shuffle(all->begin(), all->end(), random);
      const std::size_t half = all->size() / 2;
      const Points points = pointsOf(*all);
      const Eigen::Matrix4d truth = randomSimilarity(seed);
      const Pair<> pair{
          cloudOf<pcl::PointXYZ>(transformed(points.leftCols(half), truth.inverse())),
          cloudOf<pcl::PointXYZ>(points.rightCols(all->size() - half)), truth};
      KSSICP registration;
      setClouds(registration, pair);
      Cloud output;
      registration.align(output);
      EXPECT_TRUE(registration.hasConverged())
          << name << ": " << registration.getFailureReason();
      const Points source = pointsOf(*pair.source);
      const Eigen::Matrix4d reachable = icpFromTruth(pair);
      EXPECT_LT(rotationErrorDegrees(poseFrom(registration), truth),
                rotationErrorDegrees(reachable, truth) + 1.5)
          << name;
      EXPECT_LT(displacement(poseFrom(registration), truth, source), 0.02) << name;
      EXPECT_NEAR(1.0, registration.getScale() / scaleIn(truth), 0.02) << name;
    }
}

TEST_F(RealClouds, ScansOfTheBunnyAreRegistered)
{
  // from nine tenths in common to hardly more than a third
  const std::pair<const char*, const char*> scans[] = {
      {"bun000", "bun045"}, {"bun000", "bun090"}, {"bun000", "bun270"},
      {"bun000", "bun315"}, {"bun000", "top3"},   {"bun045", "bun315"}};
  unsigned int seed = 20;
  for (const auto& names : scans) {
    const std::string folder = "pairs/bunny/", from = names.first, to = names.second;
    const Eigen::Matrix4d pose = loadPose(folder + to + ".T_world.txt").inverse() *
                                 loadPose(folder + from + ".T_world.txt");
    expectRight(turnedPair(load(folder + from + ".pcd", 6),
                           load(folder + to + ".pcd", 6), pose, seed++),
                from + " on " + to);
  }
}

TEST_F(RealClouds, OtherPairsAreRegisteredOrRefused)
{
  const std::pair<const char*, std::size_t> pairs[] = {
      {"cgal_hippo", 1}, {"pcl_bun4to0", 1}, {"pcl_room", 16}, {"lpm_tutorial", 5}};
  unsigned int seed = 30;
  for (const auto& named : pairs) {
    const std::string name = std::string("pairs/") + named.first;
    expectRightOrRefused(turnedPair(load(name + "_source.pcd", named.second),
                                    load(name + "_target.pcd", named.second),
                                    loadPose(name + "_T_icp.txt"), seed++),
                         named.first, named.first == std::string("cgal_hippo"));
  }
}

TEST_F(RealClouds, DifferentObjectsAreRefusedOrAmbiguous)
{
  const std::pair<const char*, std::size_t> objects[] = {
      {"kitten_points", 1}, {"oni_points", 1}, {"ball_points", 6}};
  const auto object = [&](int i) {
    return load(std::string("objects/") + objects[i % 3].first + ".pcd",
                objects[i % 3].second);
  };
  for (int i = 0; i < 3; ++i) {
    KSSICP registration;
    registration.setInputSource(object(i));
    registration.setInputTarget(object(i + 1));
    Cloud output;
    registration.align(output);
    // Round things of unknown scale lie on each other here and there, but nowhere
    // better than elsewhere.
    EXPECT_TRUE(!registration.hasConverged() || registration.isAmbiguous())
        << objects[i].first << " on " << objects[(i + 1) % 3].first << ", score "
        << registration.getOverlap().score << ", scale " << registration.getScale();
  }
}

} // namespace
