/*
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * KSSICP where sizes, places or numbers of points leave no answer, or would, if points
 * that are far off counted.
 */

#include "failure.h"

#include <utility>

namespace {

using namespace kss_test;

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
    // no copies of each other
    registration_.setInputSource(cloudOf<pcl::PointXYZ>(scattered(number, 40)));
    registration_.setInputTarget(cloudOf<pcl::PointXYZ>(scattered(number, 41)));
    expectFailure();
    expectReason("too few");
  }
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
