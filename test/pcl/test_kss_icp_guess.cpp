/*
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * What KSSICP finds: the same whenever it is asked, on any number of threads, whatever
 * the guess; and in the scale that is known.
 */

#include "trial.h"

#include <pcl/registration/kss/detail/cloud_conversion.h>

#include <limits>
#include <random>

namespace {

using namespace kss_test;
using ICP = pcl::IterativeClosestPoint<pcl::PointXYZ, pcl::PointXYZ>;

TEST(KSSICP, CanBeUsedAgainAndAgain)
{
  Trial trial(pairOf(randomSimilarity(14)));
  for (unsigned int seed = 15; seed < 18; ++seed) {
    const auto pair = pairOf(randomSimilarity(seed), seed);
    setClouds(trial.registration, pair);
    const Eigen::Matrix4f found = trial.align();
    EXPECT_TRUE(trial.registration.hasConverged());
    expectRight(trial.registration, pair);
    // nothing of the runs before is left: the same bits as from a new object
    EXPECT_EQ(Trial(pair).align(), found);
    EXPECT_EQ(found, trial.align());
    // a new source alone
    const auto other = pairOf(randomSimilarity(seed + 10), seed);
    trial.registration.setInputSource(other.source);
    trial.align();
    EXPECT_TRUE(trial.registration.hasConverged());
    expectRight(trial.registration, other);
  }
}

TEST(KSSICP, GivesTheSameBitsWithAnyNumberOfThreads)
{
  const auto pair = pairOf(randomSimilarity(19));
  for (const char* device : {"auto", "host"}) {
    Trial first(pair);
    first.registration.setDevice(device);
    first.registration.setNumberOfThreads(1);
    const Eigen::Matrix4f expected = first.align();
    for (const unsigned int threads : {1u, 2u, 0u}) {
      Trial trial(pair);
      trial.registration.setDevice(device);
      trial.registration.setNumberOfThreads(threads);
      EXPECT_EQ(expected, trial.align()) << device << ", " << threads << " threads";
      EXPECT_EQ(first.registration.getOverlap().score,
                trial.registration.getOverlap().score);
      EXPECT_EQ(first.registration.getAlternatives().size(),
                trial.registration.getAlternatives().size());
    }
  }
}

TEST(KSSICP, RegistersACloudWithItself)
{
  auto pair = pairOf(Eigen::Matrix4d::Identity(), 20);
  pair.source = pair.target;
  Trial trial(pair);
  trial.align();
  EXPECT_TRUE(trial.registration.hasConverged())
      << trial.registration.getFailureReason();
  expectRight(trial.registration, pair, 1e-5);
  EXPECT_NEAR(0.0, trial.registration.getFitnessScore(), 1e-9);
}

TEST(KSSICP, RegistersACloudWithATurnedCopyOfItself)
{
  for (unsigned int seed = 21; seed < 24; ++seed) {
    auto pair = pairOf(randomRigid(seed), seed);
    pair.source = cloudOf<pcl::PointXYZ>(
        transformed(pointsOf(*pair.target), pair.truth.inverse()));
    Trial trial(pair);
    trial.registration.setScaleEstimation(false);
    trial.align();
    EXPECT_TRUE(trial.registration.hasConverged())
        << trial.registration.getFailureReason();
    // Every point meets its own again. Floats of up to ten units round to 1e-6, and so
    // does each of a few dozen steps.
    expectRight(trial.registration, pair, 3e-5);
  }
}

TEST(KSSICP, TakesIdentityForNoGuess)
{
  const auto pair = pairOf(randomSimilarity(22));
  EXPECT_EQ(Trial(pair).align(), Trial(pair).align(Eigen::Matrix4d::Identity()));
}

TEST(KSSICP, IsNotMisledByAGuess)
{
  const auto pair = pairOf(randomSimilarity(23));
  for (const Eigen::Matrix4d& guess :
       {pair.truth, Eigen::Matrix4d(turn(170.0, {1.0, 0.0, 1.0}) * pair.truth),
        randomSimilarity(24)}) {
    Trial trial(pair);
    trial.align(guess);
    EXPECT_TRUE(trial.registration.hasConverged());
    expectRight(trial.registration, pair);
    expectTransformed(trial.output, *pair.source,
                      trial.registration.getFinalTransformation());
  }
}

TEST(KSSICP, MakesUseOfAGuess)
{
  // a search that tries a single rotation, the wrong one, cannot find the pose
  const auto pair = pairOf(turn(137.0, {1.0, 2.0, -1.0}), 25);
  Trial trial(pair);
  set(trial.registration, &pcl::kss::Settings::even_rotations, 1);
  trial.align();
  EXPECT_FALSE(trial.registration.hasConverged());
  EXPECT_NE("", trial.registration.getFailureReason());
  trial.align(turn(5.0, {0.0, 1.0, 0.0}) * pair.truth);
  EXPECT_TRUE(trial.registration.hasConverged());
  expectRight(trial.registration, pair);
}

TEST(KSSICP, IsNeverWorseThanICPFromTheGuess)
{
  // The pennant has two poses of nearly the same score: chance alone ranks them.
  std::mt19937 random(26);
  for (unsigned int seed = 0; seed < 6; ++seed) {
    const Mesh mesh = seed < 3 ? creature() : pennant();
    const auto pair = pairOf(randomRigid(seed), seed, mesh);
    const Eigen::Matrix4d guess = turn(15.0, randomVector(random, 1.0)) * pair.truth;

    ICP icp;
    icp.setMaximumIterations(300);
    icp.setEuclideanFitnessEpsilon(1e-5);
    icp.getConvergeCriteria()->setAbsoluteMSE(0.0);
    setClouds(icp, pair);
    Cloud output;
    icp.align(output, guess.cast<float>());

    Trial trial(pair);
    trial.align(guess);
    const Points source = pointsOf(*pair.source);
    const double ours = displacement(poseFrom(trial.registration), pair.truth, source);
    const double theirs = displacement(poseFrom(icp), pair.truth, source);
    EXPECT_LT(ours, theirs) << seed;
    // surfaces determine it more closely than points do
    EXPECT_LT(ours, 0.01) << seed;
    // and its score is that of the pose
    const auto local = [](const Cloud& cloud) {
      return pcl::kss::toLocalCloud(
          cloud, pcl::kss::usablePointsOf(cloud, pcl::kss::allIndices(cloud)));
    };
    pcl::kss::Stages stages;
    const pcl::kss::PoseScorer scorer =
        pcl::kss::Alignment(trial.registration.getSettings())
            .align(local(*pair.source), local(*pair.target), {}, stages)
            .scorer;
    EXPECT_NEAR(scorer.scored(poseFrom(trial.registration)).overlap.score,
                trial.registration.getOverlap().score, 1e-6);
  }
}

TEST(KSSICP, KeepsAKnownScale)
{
  const auto pair = pairOf(randomRigid(27), 27);
  Trial trial(pair);
  trial.registration.setScaleEstimation(false);
  trial.align();
  EXPECT_TRUE(trial.registration.hasConverged());
  expectRight(trial.registration, pair);
  // a product of at most a hundred float rotations
  EXPECT_NEAR(1.0, trial.registration.getScale(), 1e-5);
  for (const auto& alternative : trial.registration.getAlternatives())
    EXPECT_NEAR(1.0, pcl::kss::scaleOf(alternative.transformation), 1e-5);

  // The scale of the guess, whatever the rest of it is worth.
  const auto scaled = pairOf(randomSimilarity(28), 28);
  const double scale = scaleIn(scaled.truth);
  setClouds(trial.registration, scaled);
  Eigen::Matrix4d guess = Eigen::Matrix4d::Identity();
  guess.topLeftCorner<3, 3>() *= scale;
  trial.align(guess);
  EXPECT_TRUE(trial.registration.hasConverged());
  expectRight(trial.registration, scaled);
  EXPECT_NEAR(scale, trial.registration.getScale(), 1e-5 * scale);
  // even where it is wrong
  guess.topLeftCorner<3, 3>() *= 1.05;
  trial.align(guess);
  EXPECT_NEAR(1.05 * scale, trial.registration.getScale(), 1e-5 * scale);
}

TEST(KSSICP, GivesTheFitnessScoreOfItsResult)
{
  const auto pair = pairOf(randomSimilarity(29));
  Trial trial(pair);
  // nothing has been aligned yet
  EXPECT_EQ(std::numeric_limits<double>::max(), trial.registration.getFitnessScore());
  trial.align();
  for (const double max_range : {1e30, 1e-2, 1e-3}) // squared distances
    EXPECT_NEAR(meanSquaredDistance(trial.output, *pair.target, max_range),
                trial.registration.getFitnessScore(max_range), 1e-5);
  EXPECT_GT(trial.registration.getFitnessScore(),
            2.0 * trial.registration.getFitnessScore(1e-3));
  EXPECT_EQ(std::numeric_limits<double>::max(),
            trial.registration.getFitnessScore(0.0));
}

} // namespace
