/*
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * KSSICP for clouds that are not what a model would be: parts, outliers, noise,
 * symmetry; and the settings that deal with them.
 */

#include "pairs.h"

namespace {

using namespace kss_test;
using pcl::kss::Mode;
using KSSICP = pcl::KSSICP<pcl::PointXYZ, pcl::PointXYZ>;
using Cloud = pcl::PointCloud<pcl::PointXYZ>;

/** Registers as the defaults have it, but for less work. */
void
align(KSSICP& registration, const Pair<>& pair, bool scale)
{
  makeQuick(registration);
  registration.setMode(Mode::AUTOMATIC);
  set(registration, &pcl::kss::Settings::sample_points, 500);
  registration.setScaleEstimation(scale);
  setClouds(registration, pair);
  Cloud output;
  registration.align(output);
}

void
expectRegistered(const Pair<>& pair, bool scale, double tolerance = 0.01)
{
  KSSICP registration;
  align(registration, pair, scale);
  EXPECT_TRUE(registration.hasConverged()) << registration.getFailureReason();
  EXPECT_EQ("", registration.getFailureReason());
  expectRight(registration, pair, tolerance);
  EXPECT_GE(registration.getConfidence(), 0.5);
  if (!scale) {
    EXPECT_NEAR(1.0, registration.getScale(), 1e-5);
  }
}

class Partial : public ::testing::Test {
protected:
  const Points whole_ = sampled(lump(), 2000, 1), other_ = sampled(lump(), 2000, 2);
};

TEST_F(Partial, SourcesAreRegistered)
{
  expectRegistered(pairOf(part(other_, {1, 0, 0}, 0.6), whole_, randomRigid(3)), false);
  expectRegistered(pairOf(part(other_, {0, 1, 1}, 0.6), whole_, randomSimilarity(4)),
                   true);
}

TEST_F(Partial, TargetsAreRegistered)
{
  expectRegistered(pairOf(other_, part(whole_, {1, 0, 0}, 0.6), randomRigid(5)), false);
  expectRegistered(pairOf(other_, part(whole_, {0, 1, 1}, 0.6), randomSimilarity(6)),
                   true);
}

TEST_F(Partial, CloudsBothAreRegistered)
{
  const auto pair = pairOf(part(other_, {1, 0, 0}, 0.7),
                           part(whole_, {-0.2f, 1, 0}, 0.7), randomRigid(7));
  KSSICP registration;
  align(registration, pair, false);
  EXPECT_TRUE(registration.hasConverged()) << registration.getFailureReason();
  expectRight(registration, pair);
  EXPECT_EQ(Mode::AUTOMATIC, registration.getMode());
  EXPECT_EQ(Mode::PARTIAL_PARTIAL, registration.getFoundMode());
  EXPECT_LT(registration.getOverlap().source, 0.9);
  EXPECT_LT(registration.getOverlap().target, 0.9);
}

TEST_F(Partial, CloudsShowWhichTheyAre)
{
  KSSICP registration;
  align(registration, pairOf(part(other_, {1, 0, 0}, 0.6), whole_, randomRigid(8)),
        false);
  EXPECT_EQ(Mode::PARTIAL_GLOBAL, registration.getFoundMode());
  EXPECT_GT(registration.getOverlap().source, 0.95);
  EXPECT_NEAR(0.62, registration.getOverlap().target, 0.08);
  align(registration, pairOf(other_, whole_, randomRigid(9)), false);
  EXPECT_EQ(Mode::GLOBAL_GLOBAL, registration.getFoundMode());
  registration.setMode(Mode::PARTIAL_GLOBAL);
  EXPECT_EQ(Mode::PARTIAL_GLOBAL, registration.getFoundMode());
}

TEST_F(Partial, CloudsGiveTheSameBitsWithAnyNumberOfThreads)
{
  const auto pair = pairOf(withOutliers(part(other_, {1, 0, 0}, 0.6), 0.1, 10), whole_,
                           randomRigid(11));
  Eigen::Matrix4f first;
  for (const unsigned int threads : {1u, 2u}) {
    KSSICP registration;
    align(registration, pair, false);
    registration.setNumberOfThreads(threads);
    Cloud output;
    registration.align(output);
    if (threads == 1)
      first = registration.getFinalTransformation();
    EXPECT_EQ(first, registration.getFinalTransformation());
  }
}

TEST_F(Partial, CloudsWithOutliersAreRegistered)
{
  // the points that count are the first ones of the source
  for (const bool scale : {false, true}) {
    const Eigen::Matrix4d truth = scale ? randomSimilarity(12) : randomRigid(12);
    const auto pair =
        pairOf(withOutliers(other_, 0.2, 13), withOutliers(whole_, 0.2, 14), truth);
    expectRegistered(pair, scale);
  }
}

TEST_F(Partial, CloudsUnderHeavyNoiseAreRegistered)
{
  const auto pair = pairOf(noisy(sampled(lump(), 4000, 15), 0.1, 16),
                           noisy(sampled(lump(), 4000, 17), 0.1, 18), randomRigid(19));
  expectRegistered(pair, false, 0.03);
}

TEST_F(Partial, CloudsOfDifferentObjectsAreRefused)
{
  for (unsigned int seed = 20; seed < 22; ++seed) {
    const auto pair =
        pairOf(sampled(creature(), 2000, seed), whole_, randomRigid(seed));
    KSSICP registration;
    align(registration, pair, true);
    EXPECT_FALSE(registration.hasConverged())
        << registration.getOverlap().score << ", scale " << registration.getScale();
    EXPECT_NE(std::string::npos, registration.getFailureReason().find("do not fit"))
        << registration.getFailureReason();
    EXPECT_LT(registration.getConfidence(), 0.5);
  }
}

TEST(Symmetric, ObjectsAreAmbiguousAndListTheirPoses)
{
  // a block of three different edges: half turns about its axes leave it as it is
  const Mesh block = box({0, 0, 0}, {1.0, 0.7, 0.45});
  const auto pair =
      pairOf(sampled(block, 2000, 23), sampled(block, 2000, 24), randomRigid(25));
  KSSICP registration;
  align(registration, pair, false);
  EXPECT_TRUE(registration.hasConverged()) << registration.getFailureReason();
  EXPECT_TRUE(registration.isAmbiguous());
  const Points source = pointsOf(*pair.source);
  for (int axis = -1; axis < 3; ++axis) {
    const Eigen::Matrix4d pose =
        axis < 0
            ? pair.truth
            : Eigen::Matrix4d(turn(180.0, Eigen::Vector3d::Unit(axis)) * pair.truth);
    const auto& listed = registration.getAlternatives();
    EXPECT_TRUE(std::any_of(listed.begin(), listed.end(), [&](const auto& alternative) {
      return displacement(alternative.transformation, pose, source) < 0.03 &&
             alternative.overlap.score > 0.95 * registration.getOverlap().score;
    })) << axis;
  }
}

TEST(Scale, StaysInTheRangeThatWasSet)
{
  Eigen::Matrix4d truth = randomRigid(26);
  truth.topLeftCorner<3, 3>() *= 2.0;
  const auto pair = pairOf(truth, 27);
  KSSICP registration;
  makeQuick(registration);
  setClouds(registration, pair);
  registration.setScaleRange(1.8, 2.2);
  Cloud output;
  registration.align(output);
  EXPECT_TRUE(registration.hasConverged());
  expectRight(registration, pair);
  for (const auto& range : {std::make_pair(2.2, 3.0), std::make_pair(0.5, 1.8)}) {
    registration.setScaleRange(range.first, range.second);
    registration.align(output);
    EXPECT_GE(registration.getScale(), range.first * (1.0 - 1e-5));
    EXPECT_LE(registration.getScale(), range.second * (1.0 + 1e-5));
  }
  // one value: known, but not 1
  registration.setScaleRange(2.0, 2.0);
  registration.align(output);
  EXPECT_NEAR(2.0, registration.getScale(), 2e-5);
  expectRight(registration, pair);
  EXPECT_EQ(6, registration.getCovariance().rows());
  // 1 explains a pose of scale 1 as well, and is not in the range
  auto metric = pairOf(randomRigid(28), 29);
  setClouds(registration, metric);
  registration.setScaleRange(1.005, 1.1);
  registration.align(output);
  EXPECT_GE(registration.getScale(), 1.005 * (1.0 - 1e-5));
}

TEST(Paper, SettingsRegisterCompleteClouds)
{
  const auto pair = pairOf(randomSimilarity(30), 31);
  KSSICP registration;
  registration.setNumberOfThreads(1);
  pcl::kss::Settings settings = pcl::kss::paperSettings(registration.getSettings());
  EXPECT_EQ(1u, settings.threads);
  settings.sample_points = 300; // all pairs of points, and these are quick
  registration.setSettings(settings);
  setClouds(registration, pair);
  Cloud output;
  registration.align(output);
  EXPECT_TRUE(registration.hasConverged()) << registration.getFailureReason();
  expectRight(registration, pair);
  EXPECT_EQ(Mode::GLOBAL_GLOBAL, registration.getMode());
}

TEST(Confidence, DecidesOnConvergence)
{
  const auto pair = pairOf(randomSimilarity(32), 33);
  KSSICP registration;
  makeQuick(registration);
  setClouds(registration, pair);
  Cloud output;
  registration.setMinimumConfidence(1.0);
  registration.align(output);
  // nothing is that sure
  EXPECT_FALSE(registration.hasConverged());
  EXPECT_NE(std::string::npos, registration.getFailureReason().find("do not fit"));
  expectRight(registration, pair);
  registration.setMinimumConfidence(0.9);
  registration.align(output);
  EXPECT_TRUE(registration.hasConverged());
}

} // namespace
