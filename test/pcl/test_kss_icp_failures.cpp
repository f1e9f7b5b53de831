/*
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * KSSICP where there is no answer: it says so and why, throws nothing, and leaves the
 * source transformed by the guess.
 */

#include "pairs.h"

#include <pcl/registration/kss/devices.h>
#include <pcl/registration/transformation_estimation_svd.h>

namespace {

using namespace kss_test;
using KSSICP = pcl::KSSICP<pcl::PointXYZ, pcl::PointXYZ>;
using Cloud = pcl::PointCloud<pcl::PointXYZ>;

const Eigen::Matrix4f identity = Eigen::Matrix4f::Identity();

class Failure : public ::testing::Test {
protected:
  Failure()
  : pair_(pairOf(randomSimilarity(1)))
  {
    makeQuick(registration_);
    setClouds(registration_, pair_);
  }

  /** Aligns, and expects a failure that leaves nothing undone. */
  void
  expectFailure(const Eigen::Matrix4f& guess = identity)
  {
    ASSERT_NO_THROW(registration_.align(output_, guess));
    EXPECT_FALSE(registration_.hasConverged());
    EXPECT_FALSE(registration_.getFailureReason().empty());
    EXPECT_EQ(guess, registration_.getFinalTransformation());
    EXPECT_EQ(identity, registration_.getLastIncrementalTransformation());
    EXPECT_EQ(0.0, registration_.getOverlap().score);
    EXPECT_LT(registration_.getConfidence(), 1e-3);
    EXPECT_FALSE(registration_.isAmbiguous());
    EXPECT_TRUE(registration_.getAlternatives().empty());
  }

  /** The same for a source that can be transformed, with a guess and without. */
  void
  expectFailureThatTransforms(const Cloud& source)
  {
    expectFailure();
    expectTransformed(output_, source, identity);
    const Eigen::Matrix4f guess = randomSimilarity(2).cast<float>();
    expectFailure(guess);
    expectTransformed(output_, source, guess);
  }

  void
  expectReason(const std::string& part)
  {
    EXPECT_NE(std::string::npos, registration_.getFailureReason().find(part))
        << registration_.getFailureReason();
  }

  /** The object is as good as new when it is given what it needs. */
  void
  expectRecovery()
  {
    setClouds(registration_, pair_);
    registration_.align(output_);
    EXPECT_TRUE(registration_.hasConverged());
    EXPECT_EQ("", registration_.getFailureReason());
    expectRight(registration_, pair_);
  }

  const Pair<> pair_;
  KSSICP registration_;
  Cloud output_;
};

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
  expectReason("iterations");
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

TEST_F(Failure, OfSizesThatCannotBeOfOneObject)
{
  registration_.setScaleEstimation(false);
  for (const auto mode : {pcl::kss::Mode::AUTOMATIC, pcl::kss::Mode::PARTIAL_PARTIAL,
                          pcl::kss::Mode::GLOBAL_GLOBAL})
    for (const float factor : {40.0f, 400.0f, 1e3f, 1e6f, 1e10f}) {
      registration_.setMode(mode);
      const auto large = cloudOf<pcl::PointXYZ>(factor * pointsOf(*pair_.source));
      setClouds(registration_, pair_);
      registration_.setInputSource(large);
      expectFailure();
      expectReason("source is");
      expectReason("times as large as the target");
      registration_.setInputSource(pair_.target);
      registration_.setInputTarget(large);
      expectFailure();
      expectReason("target is");
      expectReason("times as large as the source");
    }
  registration_.setMode(pcl::kss::Mode::GLOBAL_GLOBAL);
  registration_.setScaleEstimation(true);
  expectRecovery();
}

TEST_F(Failure, OfGuessesBeyondTheClouds)
{
  for (const float entry : {1e9f, 1e20f, 1e38f}) {
    Eigen::Matrix4f guess = randomRigid(3).cast<float>();
    guess(1, 3) = entry;
    registration_.align(output_, guess);
    EXPECT_FALSE(registration_.hasConverged());
    expectReason("guess");
  }
  for (const float scale : {1e-38f, 1e-20f, 1e-3f, 1e3f}) {
    Eigen::Matrix4f guess = randomRigid(3).cast<float>();
    guess.topLeftCorner<3, 3>() *= scale;
    // the target's own middle
    guess.topRightCorner<3, 1>() =
        pointsOf(*pair_.target).rowwise().mean() -
        guess.topLeftCorner<3, 3>() * pointsOf(*pair_.source).rowwise().mean();
    for (const bool estimate : {true, false}) {
      registration_.setScaleEstimation(estimate);
      registration_.align(output_, guess);
      EXPECT_FALSE(registration_.hasConverged());
      expectReason(scale > 1e-37f ? "times as large" : "guess");
    }
  }
  registration_.setScaleEstimation(true);
  expectRecovery();
}

TEST_F(Failure, OfScaleRangesFarFromTheClouds)
{
  using Range = std::pair<double, double>;
  for (const auto mode : {pcl::kss::Mode::AUTOMATIC, pcl::kss::Mode::GLOBAL_GLOBAL})
    for (const Range& range :
         {Range{1e300, 1e308}, Range{1e30, 1e300}, Range{1e3, 2e3}, Range{1e-3, 2e-3},
          Range{0.0, 1e-20}, Range{1e-308, 1e-300}}) {
      registration_.setMode(mode);
      registration_.setScaleRange(range.first, range.second);
      expectFailureThatTransforms(*pair_.source);
    }
  registration_.setScaleRange(0.0, 1e308);
  registration_.setMode(pcl::kss::Mode::GLOBAL_GLOBAL);
  expectRecovery();
}

TEST_F(Failure, OfSizesThatSinglePrecisionCannotSquare)
{
  for (const float size : {1e-40f, 1e-30f, 1e-15f, 1e15f, 1e20f, 1e30f, 1e37f}) {
    const auto wide = cloudOf<pcl::PointXYZ>(size * pointsOf(*pair_.source));
    setClouds(registration_, pair_);
    registration_.setInputSource(wide);
    expectFailure();
    expectReason("source");
    setClouds(registration_, pair_);
    registration_.setInputTarget(wide);
    expectFailure();
    expectReason("target");
  }
  expectRecovery();
}

TEST_F(Failure, OfPlacesThatSinglePrecisionCannotTellApart)
{
  // one coordinate of all points is the same, the others are what they were
  for (const float place : {1e9f, 1e20f, 1e36f}) {
    const Eigen::Vector3f shift(0.0f, place, 0.0f);
    const auto far = cloudOf<pcl::PointXYZ>(pointsOf(*pair_.target).colwise() + shift);
    setClouds(registration_, pair_);
    registration_.setInputTarget(far);
    expectFailure();
    expectReason("from the origin");
  }
  expectRecovery();
}

TEST_F(Failure, OfATargetThatPCLsTreeCannotHold)
{
  const auto wide = pcl::make_shared<Cloud>(*pair_.target);
  for (int i = 0; i < 40; ++i) {
    const float place = (i % 2 ? -3e38f : 3e38f) / (1 + i);
    wide->push_back({place, -place, place});
  }
  registration_.setInputTarget(wide);
  expectFailure();
  expectReason("target");
  expectRecovery();
}

TEST_F(Failure, OfTooFewPoints)
{
  for (const Eigen::Index number : {3, 4, 5, 8, 12}) {
    const auto few = cloudOf<pcl::PointXYZ>(scattered(number, 40));
    registration_.setInputSource(few);
    registration_.setInputTarget(few);
    expectFailure();
    expectReason("too few");
  }
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

TEST_F(Failure, OfAFewPointsIsNoneOfTheClouds)
{
  for (const float distance : {1e5f, 1e7f, 1e12f, 1e25f}) {
    Pair<> pair = pair_;
    pair.source = pcl::make_shared<Cloud>(*pair_.source);
    pair.target = pcl::make_shared<Cloud>(*pair_.target);
    for (const float sign : {1.0f, -1.0f, 0.5f, -0.7f, 0.2f})
      pair.source->push_back({sign * distance, -distance, 0.3f * sign * distance});
    pair.target->push_back({distance, distance, -distance});
    setClouds(registration_, pair);
    registration_.align(output_);
    EXPECT_TRUE(registration_.hasConverged()) << registration_.getFailureReason();
    expectRight(registration_, pair_);
    EXPECT_EQ(5, registration_.getNumberOfFarPoints().source);
    EXPECT_EQ(1, registration_.getNumberOfFarPoints().target);
    EXPECT_EQ(pair.source->size(), output_.size());
  }
  expectRecovery();
  EXPECT_EQ(0, registration_.getNumberOfFarPoints().source);
  EXPECT_EQ(0, registration_.getNumberOfFarPoints().target);
}

} // namespace
