/*
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * KSSICP where nothing fits, but something else would: it says what.
 */

#include "failure.h"

#include <utility>
#include <vector>

namespace {

using namespace kss_test;

/** Points of a thick wire that winds twice round an axis, and ends in a hook: its
 * mirror image winds the other way. */
Points
screw(Eigen::Index number, unsigned int seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> share(0.0f, 1.0f);
  std::normal_distribution<float> coordinate;
  Points points(3, number);
  for (Eigen::Index i = 0; i < number; ++i) {
    const float along = share(random), angle = 4.0f * static_cast<float>(M_PI) * along;
    const Eigen::Vector3f axis(std::cos(angle), std::sin(angle), 2.0f * along);
    const Eigen::Vector3f side(coordinate(random), coordinate(random),
                               coordinate(random));
    points.col(i) = axis + 0.1f * side.normalized();
    if (along > 0.9f)
      points.col(i).x() += 8.0f * (along - 0.9f);
  }
  return points;
}

Pair<>
pairOfScrews()
{
  return pairOf(screw(1500, 1), screw(1800, 2), randomRigid(3));
}

Cloud::Ptr
mirrored(const Cloud& cloud)
{
  Points points = pointsOf(cloud);
  points.row(1) *= -1.0f;
  return cloudOf<pcl::PointXYZ>(points);
}

TEST_F(Failure, OfAMirrorImageIsCalledThat)
{
  registration_.setScaleEstimation(false);
  const Pair<> pair = pairOfScrews();
  setClouds(registration_, pair);
  registration_.align(output_);
  EXPECT_TRUE(registration_.hasConverged()) << registration_.getFailureReason();
  registration_.setInputSource(mirrored(*pair.source));
  registration_.align(output_);
  EXPECT_FALSE(registration_.hasConverged());
  EXPECT_EQ(pcl::kss::FailureCause::NO_FIT, registration_.getFailureCause());
  expectReason("only as its mirror image");
  // of the points that the indices name
  Cloud::Ptr both = mirrored(*pair.source);
  const auto size = static_cast<pcl::index_t>(both->size());
  *both += *cloudOf<pcl::PointXYZ>(
      transformed(sampled(cross(), 500, 5), randomSimilarity(5)));
  const auto indices = pcl::make_shared<pcl::Indices>();
  for (pcl::index_t i = 0; i < size; ++i)
    indices->push_back(i);
  registration_.setInputSource(both);
  registration_.setIndices(indices);
  registration_.align(output_);
  expectReason("only as its mirror image");
  registration_.setIndices(pcl::IndicesPtr());
  registration_.setScaleEstimation(true);
  expectRecovery();
}

TEST_F(Failure, OfNothingInParticularIsExplainedByNothing)
{
  registration_.setInputSource(cloudOf<pcl::PointXYZ>(sampled(cross(), 1500, 6)));
  for (const bool estimate : {true, false}) {
    registration_.setScaleEstimation(estimate);
    registration_.align(output_);
    EXPECT_FALSE(registration_.hasConverged());
    expectReason("do not fit: at the best pose");
  }
  registration_.setScaleEstimation(true);
  expectRecovery();
}

TEST_F(Failure, OfUnitsNamesThem)
{
  using Factor = std::pair<float, std::string>;
  registration_.setScaleEstimation(false);
  const Pair<> pair = pairOf(randomRigid(7), 7);
  for (const auto& [factor, units] :
       {Factor{1000.0f, "millimetres and the target in metres"},
        {304.8f, "millimetres and the target in feet"},
        {100.0f, "centimetres and the target in metres"},
        {25.4f, "millimetres and the target in inches"},
        {10.0f, "millimetres and the target in centimetres"},
        {2.54f, "centimetres and the target in inches"},
        {2.54f, "do not fit at the scale 1, but at 0.39"},
        {1.7f, "but at 0.58"},
        {1.7f, "one of them in another unit"}}) {
    setClouds(registration_, pair);
    registration_.setInputSource(
        cloudOf<pcl::PointXYZ>(factor * pointsOf(*pair.source)));
    registration_.align(output_);
    EXPECT_FALSE(registration_.hasConverged()) << factor;
    expectReason(units);
  }
  // and the other way round
  registration_.setInputTarget(cloudOf<pcl::PointXYZ>(2.54f * pointsOf(*pair.target)));
  registration_.setInputSource(pair.source);
  registration_.align(output_);
  expectReason("do not fit at the scale 1, but at 2.5");
  expectReason("is the target in centimetres and the source in inches");
  // or at a scale that a guess gives
  Eigen::Matrix4f guess = pair.truth.cast<float>();
  guess.topRows<3>() *= 0.254f;
  registration_.align(output_, guess);
  expectReason("is the target in millimetres and the source in centimetres");
  registration_.setScaleEstimation(true);
  expectRecovery();
}

TEST_F(Failure, IsExplainedWithinTheTimeLimit)
{
  const Pair<> pair = pairOfScrews();
  setClouds(registration_, pair);
  registration_.setInputSource(mirrored(*pair.source));
  // what is asked for ends within it, and what explains it does not
  bool cancelled = false;
  registration_.setProgressCallback([&](const std::string& stage, double done) {
    if (stage == "final ICP" && done == 1.0) {
      registration_.cancel();
      cancelled = true;
    }
  });
  registration_.align(output_);
  EXPECT_TRUE(cancelled);
  EXPECT_EQ(pcl::kss::FailureCause::NO_FIT, registration_.getFailureCause());
  expectReason("do not fit: at the best pose");
  registration_.setProgressCallback({});
  expectRecovery();
}

} // namespace
