/*
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * KSSICP where all goes well: in the place of IterativeClosestPoint, call by call.
 */

#include "trial.h"

#include <string>
#include <type_traits>
#include <vector>

namespace {

using namespace kss_test;
using ICP = pcl::IterativeClosestPoint<pcl::PointXYZ, pcl::PointXYZ>;
using Registration = pcl::Registration<pcl::PointXYZ, pcl::PointXYZ>;

/** Members of IterativeClosestPoint's that have to be as public here as there. */
template <typename T, typename = void>
struct HasPublicClassName : std::false_type {
};
template <typename T>
struct HasPublicClassName<T, std::void_t<decltype(std::declval<T&>().getClassName())>>
: std::true_type {
};
template <typename T, typename = void>
struct HasPublicCriteria : std::false_type {
};
template <typename T>
struct HasPublicCriteria<
    T,
    std::void_t<decltype(std::declval<T&>().convergence_criteria_)>> : std::true_type {
};

TEST(KSSICP, RegistersWithoutAGuess)
{
  for (unsigned int seed = 0; seed < 4; ++seed) {
    const auto pair = pairOf(randomSimilarity(seed), seed);
    Trial trial(pair);
    trial.align();
    EXPECT_TRUE(trial.registration.hasConverged());
    EXPECT_EQ("", trial.registration.getFailureReason());
    expectRight(trial.registration, pair);
    expectTransformed(trial.output, *pair.source,
                      trial.registration.getFinalTransformation());
    EXPECT_NEAR(scaleIn(pair.truth), trial.registration.getScale(),
                0.01 * scaleIn(pair.truth));
    EXPECT_NEAR(scaleIn(poseFrom(trial.registration)), trial.registration.getScale(),
                1e-5);
  }
}

TEST(KSSICP, RegistersWithItsDefaultsAndTheEulerGrid)
{
  const auto pair = pairOf(randomSimilarity(5));
  KSSICP registration;
  setClouds(registration, pair);
  Cloud output;
  registration.align(output);
  EXPECT_TRUE(registration.hasConverged());
  expectRight(registration, pair);
  makeQuick(registration);
  set(registration, &pcl::kss::Settings::rotation_set, pcl::kss::RotationSet::EULER);
  set(registration, &pcl::kss::Settings::density, pcl::kss::Density::PAPER);
  registration.align(output);
  EXPECT_TRUE(registration.hasConverged());
  expectRight(registration, pair);
}

TEST(KSSICP, TellsHowItWent)
{
  const auto pair = pairOf(randomSimilarity(6));
  Trial trial(pair);
  auto& registration = trial.registration;
  EXPECT_EQ(0.0, registration.getOverlap().score);
  EXPECT_EQ(0.0, registration.getOverlap().source);
  EXPECT_EQ(0.0, registration.getOverlap().target);
  EXPECT_LT(registration.getConfidence(), 1e-3);
  EXPECT_FALSE(registration.isAmbiguous());
  EXPECT_FALSE(registration.hasConverged());
  trial.align();

  const auto& alternatives = registration.getAlternatives();
  ASSERT_FALSE(alternatives.empty());
  EXPECT_EQ(poseFrom(registration), alternatives.front().transformation);
  EXPECT_EQ(registration.getOverlap().score, alternatives.front().overlap.score);
  // the result is the likeliest, or as good
  for (const auto& other : alternatives)
    EXPECT_TRUE(logOddsOf(alternatives.front()) >= logOddsOf(other) ||
                areEquallyGood(alternatives.front(), other));
  // then the others, the likeliest first, and again those without a run of ICP
  int rises = 0;
  for (std::size_t i = 2; i < alternatives.size(); ++i)
    rises += logOddsOf(alternatives[i - 1]) < logOddsOf(alternatives[i]);
  EXPECT_LE(rises, 1);
  EXPECT_NEAR(1.5, registration.getOverlap().score, 0.15);
  EXPECT_GT(registration.getOverlap().source, 0.95);
  EXPECT_GT(registration.getOverlap().target, 0.95);
  EXPECT_GT(registration.getConfidence(), 0.95);
  EXPECT_FALSE(registration.isAmbiguous());
  EXPECT_FALSE(registration.getDeviceName().empty());

  std::vector<std::string> stages;
  for (const auto& stage : registration.getStageSeconds()) {
    stages.push_back(stage.stage);
    EXPECT_GE(stage.seconds, 0.0);
  }
  EXPECT_EQ((std::vector<std::string>{"preparation", "simplification", "search",
                                      "refinement", "final ICP"}),
            stages);
  registration.setDevice("host");
  trial.align();
  EXPECT_EQ("host", registration.getDeviceName());
  EXPECT_EQ(5u, registration.getStageSeconds().size());
}

TEST(KSSICP, IsTheSameForAnyNumberOfIterationsThatAreEnough)
{
  // a scale of one, which has a run of its own
  const auto pair = pairOf(randomRigid(29));
  const auto foundWithin = [&](int iterations) {
    KSSICP registration;
    registration.setMaximumIterations(iterations);
    setClouds(registration, pair);
    Cloud output;
    registration.align(output);
    EXPECT_TRUE(registration.hasConverged()) << iterations;
    return registration.getFinalTransformation();
  };
  const Eigen::Matrix4f expected = foundWithin(300);
  for (const int iterations : {39, 40, 41, 79, 80, 81})
    EXPECT_EQ(expected, foundWithin(iterations)) << iterations;
}

TEST(KSSICP, HasTheInterfaceOfIterativeClosestPoint)
{
  const auto pair = pairOf(randomSimilarity(7));
  KSSICP registration;
  EXPECT_TRUE(HasPublicClassName<ICP>::value);
  EXPECT_TRUE(HasPublicClassName<KSSICP>::value);
  EXPECT_TRUE(HasPublicCriteria<ICP>::value);
  EXPECT_TRUE(HasPublicCriteria<KSSICP>::value);
  ICP& as_icp = registration;
  EXPECT_EQ("KSSICP", as_icp.getClassName());
  EXPECT_EQ(300, registration.getMaximumIterations());
  EXPECT_EQ(1e-5, registration.getEuclideanFitnessEpsilon());
  EXPECT_EQ(0.0, registration.getTransformationEpsilon());

  registration.setMaximumIterations(60);
  EXPECT_EQ(60, registration.getMaximumIterations());
  registration.setRANSACIterations(7);
  EXPECT_EQ(7, registration.getRANSACIterations());
  registration.setRANSACOutlierRejectionThreshold(0.3);
  EXPECT_EQ(0.3, registration.getRANSACOutlierRejectionThreshold());
  registration.setMaxCorrespondenceDistance(5.0);
  EXPECT_EQ(5.0, registration.getMaxCorrespondenceDistance());
  registration.setTransformationEpsilon(1e-14);
  EXPECT_EQ(1e-14, registration.getTransformationEpsilon());
  registration.setTransformationRotationEpsilon(0.9999999);
  EXPECT_EQ(0.9999999, registration.getTransformationRotationEpsilon());
  registration.setEuclideanFitnessEpsilon(1e-6);
  EXPECT_EQ(1e-6, registration.getEuclideanFitnessEpsilon());
  registration.setUseReciprocalCorrespondences(true);
  EXPECT_TRUE(registration.getUseReciprocalCorrespondences());
  registration.setPointRepresentation(
      pcl::make_shared<pcl::DefaultPointRepresentation<pcl::PointXYZ>>());
  EXPECT_EQ(as_icp.convergence_criteria_, registration.getConvergeCriteria());

  const auto target_tree = pcl::make_shared<KSSICP::KdTree>();
  registration.setSearchMethodTarget(target_tree);
  EXPECT_EQ(target_tree, registration.getSearchMethodTarget());
  const auto source_tree = pcl::make_shared<KSSICP::KdTreeReciprocal>();
  registration.setSearchMethodSource(source_tree);
  EXPECT_EQ(source_tree, registration.getSearchMethodSource());

  setClouds(registration, pair);
  EXPECT_EQ(pair.source, registration.getInputSource());
  EXPECT_EQ(pair.target, registration.getInputTarget());
  Cloud output;
  registration.align(output);
  EXPECT_TRUE(registration.hasConverged());
  expectRight(registration, pair);
  EXPECT_EQ(pair.target, target_tree->getInputCloud());
  // the last step of a run that has converged is a small one
  EXPECT_TRUE(registration.getLastIncrementalTransformation().isIdentity(1e-3f));
  EXPECT_DOUBLE_EQ(1.5, registration.getFitnessScore({1, 3, 5}, {0, 2, 2.5}));
}

TEST(KSSICP, WorksThroughPointersToItsBases)
{
  const auto pair = pairOf(randomSimilarity(8));
  Trial trial(pair);
  const Eigen::Matrix4f expected = trial.align();

  const auto kss_icp = pcl::make_shared<KSSICP>();
  makeQuick(*kss_icp);
  const Registration::Ptr registration = kss_icp;
  setClouds(*registration, pair);
  Cloud output;
  registration->align(output);
  EXPECT_TRUE(registration->hasConverged());
  EXPECT_EQ(expected, registration->getFinalTransformation());
  expectTransformed(output, *pair.source, expected);
  EXPECT_NEAR(trial.registration.getFitnessScore(), registration->getFitnessScore(),
              1e-6);

  const ICP::Ptr icp = kss_icp;
  icp->setUseReciprocalCorrespondences(false);
  setClouds(*icp, pair);
  icp->align(output, Eigen::Matrix4f::Identity());
  EXPECT_TRUE(icp->hasConverged());
  EXPECT_EQ(expected, icp->getFinalTransformation());
  icp->align(*pair.source);
  expectTransformed(*pair.source, *cloudOf<pcl::PointXYZ>(pointsOf(output)),
                    Eigen::Matrix4f(Eigen::Matrix4f::Identity()));

  // an empty cloud is refused through a base, too
  registration->setInputSource(pcl::make_shared<Cloud>());
  registration->align(output);
  EXPECT_FALSE(registration->hasConverged());
}

TEST(Precision, IsThatOfTheErrors)
{
  constexpr int trials = 16;
  double squares = 0.0;
  for (unsigned int seed = 0; seed < trials; ++seed) {
    const auto cloud = [&](unsigned int which) {
      const Points points = sampled(creature(), 1500, 10 * seed + which);
      return noisy(points, 0.01, 10 * seed + 5 + which);
    };
    const auto pair = pairOf(cloud(0), cloud(1), randomRigid(seed));
    Trial trial(pair);
    trial.registration.setScaleEstimation(false);
    EXPECT_EQ(0, trial.registration.getCovariance().size());
    trial.align();
    const Eigen::MatrixXd covariance = trial.registration.getCovariance();
    ASSERT_EQ(6, covariance.rows());
    EXPECT_EQ(0.0, trial.registration.getScaleDeviation());
    EXPECT_EQ(0, trial.registration.getUndeterminedDirections());
    const Eigen::Matrix4d found = poseFrom(trial.registration);
    const Eigen::AngleAxisd turn(
        Eigen::Matrix3d((pair.truth * found.inverse()).topLeftCorner<3, 3>()));
    const Eigen::Vector3d center =
        pointsOf(*pair.source).rowwise().mean().cast<double>();
    Eigen::VectorXd error(6);
    error << turn.angle() * turn.axis(),
        ((pair.truth - found) * center.homogeneous()).head<3>();
    squares += error.dot(covariance.llt().solve(error)) / 6.0;
  }
  EXPECT_GT(squares / trials, 0.4);
  EXPECT_LT(squares / trials, 2.5);
}

TEST(Precision, TellsOfTheScaleWhereThatIsEstimated)
{
  const auto pair =
      pairOf(noisy(sampled(creature(), 1500, 1), 0.01, 2),
             noisy(sampled(creature(), 1500, 3), 0.01, 4), randomSimilarity(5));
  Trial trial(pair);
  trial.align();
  EXPECT_EQ(7, trial.registration.getCovariance().rows());
  const double deviation = trial.registration.getScaleDeviation();
  const double scale = trial.registration.getScale();
  EXPECT_GT(deviation, 1e-4 * scale);
  EXPECT_LT(deviation, 1e-2 * scale);
  EXPECT_NEAR(std::cbrt(pair.truth.topLeftCorner<3, 3>().determinant()), scale,
              5.0 * deviation);
}

TEST(Evidence, IsOfTheResult)
{
  const auto pair = pairOf(randomSimilarity(6));
  Trial trial(pair);
  EXPECT_EQ(0.0, trial.registration.getEvidence().source.explained);
  trial.align();
  const pcl::kss::Evidence evidence = trial.registration.getEvidence();
  for (const pcl::kss::Support& support : {evidence.source, evidence.target}) {
    EXPECT_GT(support.near, 0.95);
    EXPECT_GT(support.explained, 0.7);
    EXPECT_GT(support.worst, 0.4);
    EXPECT_GE(support.consistent, support.worst - 1e-6);
  }
  EXPECT_LT(evidence.residual, 1.5);
}

} // namespace
