/*
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * KSSICP where there is no answer: it says so and why, throws nothing, and leaves the
 * source transformed by the guess.
 */

#include "failure.h"

#include <pcl/registration/kss/devices.h>
#include <pcl/registration/transformation_estimation_svd.h>

#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using namespace kss_test;

TEST_F(Failure, WithoutClouds)
{
  KSSICP bare;
  EXPECT_NO_THROW(bare.align(output_));
  EXPECT_FALSE(bare.hasConverged());
  EXPECT_NE("", bare.getFailureReason());
  EXPECT_TRUE(output_.empty());
  bare.setInputSource(pair_.source);
  bare.align(output_);
  EXPECT_FALSE(bare.hasConverged());
  expectTransformed(output_, *pair_.source, identity);
  EXPECT_EQ(std::numeric_limits<double>::max(), bare.getFitnessScore());
  KSSICP no_source;
  no_source.setInputTarget(pair_.target);
  no_source.align(output_);
  EXPECT_FALSE(no_source.hasConverged());
  EXPECT_TRUE(output_.empty());
}

TEST_F(Failure, WhenNothingReplacesACloud)
{
  for (const auto& nothing : {Cloud::Ptr(), pcl::make_shared<Cloud>()}) {
    expectRecovery();
    registration_.setInputSource(nothing);
    EXPECT_FALSE(registration_.hasConverged());
    EXPECT_EQ(nullptr, registration_.getInputSource());
    expectFailure();
    expectReason("source");
    EXPECT_TRUE(output_.empty());

    expectRecovery();
    registration_.setInputTarget(nothing);
    EXPECT_FALSE(registration_.hasConverged());
    EXPECT_EQ(nullptr, registration_.getInputTarget());
    expectFailureThatTransforms(*pair_.source);
    expectReason("target");
  }
  expectRecovery();
  // the same through a base, whose align() is PCL's own
  pcl::Registration<pcl::PointXYZ, pcl::PointXYZ>& base = registration_;
  base.setInputTarget(pcl::make_shared<Cloud>());
  base.align(output_);
  EXPECT_FALSE(base.hasConverged());
  expectRecovery();
}

TEST_F(Failure, OfCloudsThatDetermineNoPose)
{
  const auto one = cloudOf<pcl::PointXYZ>(Points::Constant(3, 1, 0.5f));
  const auto two = cloudOf<pcl::PointXYZ>(scattered(2, 3));
  const auto equal = cloudOf<pcl::PointXYZ>(Points::Constant(3, 400, 0.5f));
  const auto nan = pcl::make_shared<Cloud>(*equal);
  for (pcl::PointXYZ& point : *nan)
    makeNaN(point);
  nan->is_dense = false;
  Points row(3, 400);
  for (Eigen::Index i = 0; i < row.cols(); ++i)
    row.col(i) = Eigen::Vector3f(0.3f, -0.1f, 0.7f) * static_cast<float>(i);
  const auto line = cloudOf<pcl::PointXYZ>(row);
  for (const auto& bad : {one, two, equal, nan, line})
    for (const auto density : {pcl::kss::Density::UNIFORM, pcl::kss::Density::PAPER}) {
      set(registration_, &pcl::kss::Settings::density, density);
      setClouds(registration_, pair_);
      registration_.setInputSource(bad);
      expectFailureThatTransforms(*bad);
      expectReason("source");
      setClouds(registration_, pair_);
      registration_.setInputTarget(bad);
      expectFailureThatTransforms(*pair_.source);
      expectReason("target");
    }
  expectRecovery();
}

TEST_F(Failure, OfIndicesThatNameNoPoints)
{
  const auto size = static_cast<pcl::index_t>(pair_.source->size());
  for (const pcl::index_t wrong :
       {size, -1, std::numeric_limits<pcl::index_t>::max()}) {
    registration_.setIndices(
        pcl::make_shared<pcl::Indices>(pcl::Indices{0, 5, wrong, 7, 2}));
    expectFailure();
    expectReason(std::to_string(wrong));
    // those that do name points are there
    expectTransformed(output_, picked(*pair_.source, {0, 5, 7, 2}), identity);
  }
  registration_.setIndices(pcl::make_shared<pcl::Indices>());
  expectFailure();
  EXPECT_TRUE(output_.empty());
  registration_.setIndices(pcl::IndicesPtr());
  expectRecovery();
}

TEST_F(Failure, OfGuessesThatAreNoSimilarities)
{
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinity = std::numeric_limits<float>::infinity();
  std::vector<Eigen::Matrix4f> guesses(6, randomSimilarity(4).cast<float>());
  guesses[0](1, 2) = nan;
  guesses[1](0, 3) = infinity;
  guesses[2].setZero();
  guesses[3].col(1) *= -1.0f; // mirrors
  guesses[4].row(0) *= 1.5f;  // stretches
  guesses[5](3, 1) = 0.5f;    // projects
  for (const Eigen::Matrix4f& guess : guesses) {
    ASSERT_NO_THROW(registration_.align(output_, guess));
    EXPECT_FALSE(registration_.hasConverged());
    expectReason("guess");
    // what cannot be applied is not: everything stays finite and in place
    EXPECT_EQ(identity, registration_.getFinalTransformation());
    expectTransformed(output_, *pair_.source, identity);
  }
  expectRecovery();
}

TEST_F(Failure, WithoutCorrespondences)
{
  registration_.setMaxCorrespondenceDistance(1e-7);
  expectFailureThatTransforms(*pair_.source);
  expectReason("correspondences");
  registration_.setMaxCorrespondenceDistance(100.0);
  expectRecovery();
}

TEST_F(Failure, AtTheIterationLimit)
{
  registration_.setMaximumIterations(1);
  registration_.align(output_);
  EXPECT_FALSE(registration_.hasConverged());
  expectReason("after 1 iteration;");
  // it is still the best that could be had
  expectRight(registration_, pair_, 0.05);
  expectTransformed(output_, *pair_.source, registration_.getFinalTransformation());
  EXPECT_FALSE(registration_.getAlternatives().empty());
  // ICP's own reading
  registration_.getConvergeCriteria()->setFailureAfterMaximumIterations(false);
  registration_.align(output_);
  EXPECT_TRUE(registration_.hasConverged());
  EXPECT_EQ("", registration_.getFailureReason());
  registration_.getConvergeCriteria()->setFailureAfterMaximumIterations(true);
  registration_.setMaximumIterations(300);
  expectRecovery();
}

TEST_F(Failure, OfShapesThatDiffer)
{
  for (unsigned int seed = 5; seed < 8; ++seed) {
    // whatever they may be parts of
    registration_.setMode(seed == 7 ? pcl::kss::Mode::AUTOMATIC
                                    : pcl::kss::Mode::GLOBAL_GLOBAL);
    const auto other = cloudOf<pcl::PointXYZ>(
        transformed(sampled(cross(), 1500, seed), randomSimilarity(seed)));
    registration_.setInputSource(other);
    registration_.align(output_);
    EXPECT_FALSE(registration_.hasConverged());
    expectReason("do not fit");
    EXPECT_LT(registration_.getConfidence(), registration_.getMinimumConfidence());
    // the best pose is there to be looked at
    expectTransformed(output_, *other, registration_.getFinalTransformation());
    EXPECT_FALSE(registration_.getAlternatives().empty());
  }
  // as far apart as the caller will have it
  registration_.setMinimumConfidence(0.0);
  registration_.align(output_);
  EXPECT_TRUE(registration_.hasConverged());
  registration_.setMinimumConfidence(0.5);
  expectRecovery();
}

TEST_F(Failure, OfADeviceThatDoesNotExist)
{
  registration_.setDevice("Difference Engine");
  expectFailureThatTransforms(*pair_.source);
  expectReason("Difference Engine");
  for (const std::string& name : pcl::kss::openCLDeviceNames())
    expectReason(name);
  registration_.setDevice("host");
  expectRecovery();
}

TEST_F(Failure, LeavesNothingOfTheRunBefore)
{
  expectRecovery();
  EXPECT_FALSE(registration_.getStageSeconds().empty());
  EXPECT_FALSE(registration_.getDeviceName().empty());
  registration_.setInputSource(nullptr);
  expectFailure();
  // no stage ran, on no device
  EXPECT_TRUE(registration_.getStageSeconds().empty());
  EXPECT_EQ("", registration_.getDeviceName());
}

TEST_F(Failure, InPlaceLeavesTheSourceTransformedByTheGuess)
{
  registration_.setMaxCorrespondenceDistance(1e-7);
  const Cloud before = *pair_.source;
  const Eigen::Matrix4f guess = randomSimilarity(9).cast<float>();
  registration_.align(*pair_.source, guess);
  EXPECT_FALSE(registration_.hasConverged());
  expectTransformed(*pair_.source, before, guess);
  // and where it cannot even start
  const Cloud moved = *pair_.source;
  registration_.setInputTarget(nullptr);
  registration_.align(*pair_.source, guess);
  expectTransformed(*pair_.source, moved, guess);
}

TEST_F(Failure, OfACallbackIsReportedNotThrown)
{
  // a way to give up half way
  registration_.setProgressCallback([](const std::string& stage, double) {
    if (stage == "refinement")
      throw std::runtime_error("cancelled by the user");
  });
  expectFailureThatTransforms(*pair_.source);
  expectReason("cancelled by the user");
  registration_.setProgressCallback({});
  expectRecovery();
}

/** Estimates what no point can follow, from some iteration on. */
class BrokenEstimation
: public pcl::registration::TransformationEstimationSVD<pcl::PointXYZ, pcl::PointXYZ> {
public:
  BrokenEstimation(int good, float factor)
  : good_(good)
  , factor_(factor)
  {
  }

  void
  estimateRigidTransformation(const Cloud& source,
                              const Cloud& target,
                              const pcl::Correspondences& correspondences,
                              Matrix4& transformation) const override
  {
    TransformationEstimationSVD::estimateRigidTransformation(
        source, target, correspondences, transformation);
    if (good_-- <= 0)
      transformation.topLeftCorner<3, 3>() *= factor_;
  }

private:
  mutable int good_;
  float factor_;
};

TEST_F(Failure, OfAnEstimationKeepsThePoseOfTheSearch)
{
  for (const float factor :
       {std::numeric_limits<float>::quiet_NaN(), 0.0f, -1.0f, 1e10f})
    for (const int good : {0, 2}) {
      registration_.setTransformationEstimation(
          pcl::make_shared<BrokenEstimation>(good, factor));
      registration_.align(output_);
      EXPECT_TRUE(registration_.hasConverged()) << registration_.getFailureReason();
      expectRight(registration_, pair_, 0.03);
      EXPECT_TRUE(registration_.getLastIncrementalTransformation().allFinite());
      expectTransformed(output_, *pair_.source, registration_.getFinalTransformation());
    }
  registration_.setTransformationEstimation(
      pcl::make_shared<pcl::registration::TransformationEstimationSVD<
          pcl::PointXYZ, pcl::PointXYZ>>());
  expectRecovery();
}

} // namespace
