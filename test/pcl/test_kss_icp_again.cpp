/*
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * KSSICP called again and again: what it keeps of its work must not show. And how many
 * points the final ICP takes.
 */

#include "pairs.h"

#include <functional>

namespace {

using namespace kss_test;
using pcl::kss::Mode;
using KSSICP = pcl::KSSICP<pcl::PointXYZ, pcl::PointXYZ>;
using Cloud = pcl::PointCloud<pcl::PointXYZ>;

Cloud::Ptr
copyOf(const Cloud& cloud)
{
  return pcl::make_shared<Cloud>(cloud);
}

Cloud::Ptr
sampledCloud(const Mesh& mesh, int number, unsigned int seed)
{
  return cloudOf<pcl::PointXYZ>(
      transformed(sampled(mesh, number, seed), randomSimilarity(seed)));
}

class Again : public ::testing::Test {
protected:
  Again()
  {
    makeQuick(registration_);
    makeQuick(settings_);
    registration_.setInputSource(source_);
    registration_.setInputTarget(target_);
    expectAsFresh();
  }

  /** Change a setting; new objects get it, too. */
  void
  change(const std::function<void(KSSICP&)>& setting)
  {
    setting(registration_);
    setting(settings_);
  }

  /** The bits are those of a new object with the settings and copies of the clouds. */
  void
  expectAsFresh(KSSICP& registration) const
  {
    KSSICP fresh;
    fresh.setSettings(settings_.getSettings());
    fresh.setInputSource(copyOf(*registration.getInputSource()));
    fresh.setInputTarget(copyOf(*registration.getInputTarget()));
    Cloud expected, found;
    fresh.align(expected);
    registration.align(found);
    EXPECT_EQ(fresh.getFinalTransformation(), registration.getFinalTransformation());
    EXPECT_EQ(fresh.hasConverged(), registration.hasConverged());
    EXPECT_EQ(fresh.getFailureReason(), registration.getFailureReason());
    EXPECT_EQ(fresh.getOverlap().score, registration.getOverlap().score);
    EXPECT_EQ(fresh.getFitnessScore(), registration.getFitnessScore());
    ASSERT_EQ(fresh.getAlternatives().size(), registration.getAlternatives().size());
    for (std::size_t i = 0; i < fresh.getAlternatives().size(); ++i)
      EXPECT_EQ(fresh.getAlternatives()[i].transformation,
                registration.getAlternatives()[i].transformation);
    EXPECT_EQ(pointsOf(expected), pointsOf(found));
  }

  void
  expectAsFresh()
  {
    expectAsFresh(registration_);
  }

  const Cloud::Ptr source_ = sampledCloud(creature(), 1500, 1);
  const Cloud::Ptr target_ = sampledCloud(creature(), 1800, 2);
  KSSICP registration_, settings_;
};

TEST_F(Again, TheSameIsTheSame)
{
  expectAsFresh();
  expectAsFresh();
}

TEST_F(Again, AnotherSourceIsAsForANewObject)
{
  for (unsigned int seed = 3; seed < 5; ++seed) {
    registration_.setInputSource(sampledCloud(creature(), 1500, seed));
    expectAsFresh();
  }
  registration_.setInputSource(sampledCloud(cross(), 1500, 5));
  expectAsFresh();
  registration_.setInputSource(source_);
  expectAsFresh();
}

TEST_F(Again, AnotherTargetIsAsForANewObject)
{
  registration_.setInputTarget(sampledCloud(creature(), 1800, 6));
  expectAsFresh();
  registration_.setInputTarget(sampledCloud(lump(), 900, 7));
  expectAsFresh();
  registration_.setInputTarget(target_);
  expectAsFresh();
}

TEST_F(Again, SwappedCloudsAreAsForANewObject)
{
  registration_.setInputSource(target_);
  registration_.setInputTarget(source_);
  expectAsFresh();
  registration_.setInputTarget(target_);
  expectAsFresh();
}

TEST_F(Again, CloudsThatHaveChangedAreAsForANewObject)
{
  // in place, and PCL is told
  *target_ = *sampledCloud(creature(), 1800, 8);
  registration_.setInputTarget(target_);
  expectAsFresh();
  *source_ = *sampledCloud(creature(), 1500, 9);
  registration_.setInputSource(source_);
  expectAsFresh();
  // a single point of each
  target_->points[77].getVector3fMap() += Eigen::Vector3f(0.1f, 0.1f, 0.1f);
  registration_.setInputTarget(target_);
  expectAsFresh();
  source_->points[77].getVector3fMap() += Eigen::Vector3f(0.1f, 0.1f, 0.1f);
  registration_.setInputSource(source_);
  expectAsFresh();
  // other points in the world, the same in the frame of the cloud
  for (pcl::PointXYZ& point : *target_)
    point.getVector3fMap() += Eigen::Vector3f(64.0f, 0.0f, -128.0f);
  registration_.setInputTarget(target_);
  expectAsFresh();
  // of the source PCL keeps nothing that it would have to be told of
  for (pcl::PointXYZ& point : *source_)
    point.getVector3fMap() += Eigen::Vector3f(64.0f, 0.0f, -128.0f);
  expectAsFresh();
}

TEST_F(Again, OtherSettingsAreAsForANewObject)
{
  using namespace pcl::kss;
  const std::function<void(KSSICP&)> changes[] = {
      [](KSSICP& icp) { set(icp, &Settings::sample_points, 150); },
      [](KSSICP& icp) { set(icp, &Settings::density, Density::PAPER); },
      [](KSSICP& icp) { set(icp, &Settings::density, Density::UNIFORM); },
      [](KSSICP& icp) { set(icp, &Settings::clean, false); },
      [](KSSICP& icp) { set(icp, &Settings::even_rotations, 300); },
      [](KSSICP& icp) { set(icp, &Settings::rotation_set, RotationSet::EULER); },
      [](KSSICP& icp) { set(icp, &Settings::angle_step, M_PI / 5.0); },
      [](KSSICP& icp) { set(icp, &Settings::rotation_set, RotationSet::EVEN); },
      [](KSSICP& icp) { icp.setMode(Mode::PARTIAL_GLOBAL); },
      [](KSSICP& icp) { icp.setScaleRange(0.7, 1.2); },
      [](KSSICP& icp) { icp.setScaleEstimation(false); },
      [](KSSICP& icp) { icp.setMode(Mode::AUTOMATIC); },
      [](KSSICP& icp) { set(icp, &Settings::local_minimum_kernel, 5); },
      [](KSSICP& icp) { set(icp, &Settings::additional_process_threshold, 0.1); },
      [](KSSICP& icp) { icp.setDevice("host"); },
      [](KSSICP& icp) { icp.setNumberOfICPPoints(100); },
      [](KSSICP& icp) { icp.setNumberOfICPPoints(0); }};
  int number = 0;
  for (const auto& setting : changes) {
    SCOPED_TRACE(number++);
    change(setting);
    expectAsFresh();
  }
}

TEST_F(Again, AFailureLeavesNothingBehind)
{
  Points line(3, 100);
  for (Eigen::Index i = 0; i < 100; ++i)
    line.col(i) = Eigen::Vector3f(1.0f, 2.0f, 3.0f) * static_cast<float>(i);
  Cloud output;
  for (const bool of_source : {true, false}) {
    if (of_source)
      registration_.setInputSource(cloudOf<pcl::PointXYZ>(line));
    else
      registration_.setInputTarget(cloudOf<pcl::PointXYZ>(line));
    registration_.align(output);
    EXPECT_FALSE(registration_.hasConverged());
    registration_.setInputSource(source_);
    registration_.setInputTarget(target_);
    expectAsFresh();
  }
}

TEST_F(Again, AnotherCallbackIsTold)
{
  int first = 0, second = 0;
  Cloud output;
  registration_.setProgressCallback([&](const std::string&, double) { ++first; });
  registration_.align(output);
  EXPECT_GT(first, 0);
  const int told = first;
  registration_.setProgressCallback([&](const std::string&, double) { ++second; });
  registration_.align(output);
  EXPECT_EQ(told, first);
  EXPECT_EQ(told, second);
  registration_.setProgressCallback({});
  registration_.align(output);
  EXPECT_EQ(told, second);
}

TEST(ICPPoints, OfAnyNumberGiveAboutTheSamePose)
{
  const auto pair = pairOf(sampled(creature(), 12000, 12),
                           sampled(creature(), 12000, 13), randomSimilarity(14));
  std::vector<Eigen::Matrix4d> found;
  for (const unsigned int points : {0u, 5000u, 500u}) {
    KSSICP registration;
    EXPECT_EQ(pcl::kss::Settings().icp_points, registration.getNumberOfICPPoints());
    makeQuick(registration);
    registration.setNumberOfICPPoints(points);
    EXPECT_EQ(points, registration.getNumberOfICPPoints());
    setClouds(registration, pair);
    Cloud output;
    registration.align(output);
    EXPECT_TRUE(registration.hasConverged());
    expectTransformed(output, *pair.source, registration.getFinalTransformation());
    expectRight(registration, pair, 0.005);
    found.push_back(poseFrom(registration));
  }
  const Points source = pointsOf(*pair.source);
  EXPECT_LT(displacement(found[1], found[0], source), 0.001);
  EXPECT_LT(displacement(found[2], found[0], source), 0.003);
}

TEST(ICPPoints, AreSoManyOfThoseThatMayTakePart)
{
  struct Open : KSSICP {
    const pcl::Correspondences&
    correspondences() const
    {
      return *correspondences_;
    }
  };
  const auto pair = pairOf(randomSimilarity(15), 15);
  makeNaN((*pair.source)[2]);
  const auto indices = pcl::make_shared<pcl::Indices>();
  for (int i = 0; i < 1000; ++i)
    indices->push_back(i);
  for (const unsigned int points : {0u, 300u, 999u, 5000u}) {
    Open registration;
    makeQuick(registration);
    registration.setNumberOfICPPoints(points);
    setClouds(registration, pair);
    registration.setIndices(indices);
    Cloud output;
    registration.align(output);
    EXPECT_TRUE(registration.hasConverged());
    const auto& found = registration.correspondences();
    // where both clouds are complete, each point has its counterpart
    EXPECT_EQ(points == 0 ? 999u : std::min(points, 999u), found.size());
    const Eigen::Affine3f pose(registration.getFinalTransformation());
    for (const pcl::Correspondence& correspondence : found) {
      ASSERT_LT(correspondence.index_query, 1000);
      ASSERT_NE(2, correspondence.index_query);
      const Eigen::Vector3f placed =
          pose * (*pair.source)[correspondence.index_query].getVector3fMap();
      EXPECT_LT(
          (placed - (*pair.target)[correspondence.index_match].getVector3fMap()).norm(),
          0.3f);
    }
  }
}

} // namespace
