/*
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * Clouds in double precision, without PCL: what KSSICP makes of them.
 */

#include "oriented_shapes.h"
#include "pairs.h"
#include "poses.h"

#include <pcl/registration/kss/cloud_registration.h>
#include <pcl/registration/kss/detail/similarity.h>

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace {

using namespace kss_test;
using namespace pcl::kss;

/** As makeQuick() has it. */
Settings
quick()
{
  return quickSettings(quick_points);
}

struct CloudPair {
  Cloud source, target;
  Eigen::Matrix4d truth; ///< maps the source onto the target
};

/** Two samplings of a creature. */
CloudPair
pairOfClouds(const Eigen::Matrix4d& truth, unsigned int seed = 1)
{
  const Eigen::Matrix3Xd source = sampled(creature(), 1500, 2 * seed).cast<double>(),
                         target =
                             sampled(creature(), 1800, 2 * seed + 1).cast<double>();
  const Eigen::Matrix4d back = truth.inverse();
  return {{back.topRows<3>() * source.colwise().homogeneous()}, {target}, truth};
}

/** How far apart two poses are about a centre of the source, in the standard errors of
 * a result, squared and summed over its directions. */
double
squaredErrors(const Registered& result,
              const Eigen::Matrix4d& other,
              const Eigen::Matrix3Xd& source)
{
  const int unknowns = result.precision.unknowns;
  const Eigen::Matrix4d pose = result.transformation;
  const Eigen::Matrix3d apart =
      other.topLeftCorner<3, 3>() * pose.topLeftCorner<3, 3>().inverse();
  const double scale = std::cbrt(apart.determinant());
  const Eigen::Matrix3d turn = 0.5 / scale * (apart - apart.transpose());
  Eigen::VectorXd error(unknowns);
  error.head<3>() << turn(2, 1), turn(0, 2), turn(1, 0);
  error.segment<3>(3) =
      ((other - pose) * source.rowwise().mean().homogeneous()).head<3>();
  if (unknowns > 6)
    error[6] = std::log(scale);
  const Eigen::MatrixXd covariance =
      result.precision.covariance.topLeftCorner(unknowns, unknowns);
  return error.dot(covariance.ldlt().solve(error));
}

/** Chance alone exceeds this once in a thousand results, in seven directions. */
constexpr double by_chance = 24.3;

Points
floatsOf(const Cloud& cloud)
{
  return cloud.points.cast<float>();
}

TEST(CloudRegistration, FindsThePoseThatTheClassFinds)
{
  for (const bool is_rigid : {false, true})
    for (unsigned int seed = 1; seed <= 3; ++seed) {
      const CloudPair pair =
          pairOfClouds(is_rigid ? randomRigid(seed) : randomSimilarity(seed), seed);
      Settings settings = quick();
      settings.estimate_scale = !is_rigid;
      const Registered result =
          CloudRegistration(settings).align(pair.source, pair.target);
      EXPECT_EQ(FailureCause::NONE, result.failure.cause) << result.failure.reason;
      ASSERT_EQ(is_rigid ? 6 : 7, result.precision.unknowns);
      EXPECT_LT(squaredErrors(result, pair.truth, pair.source.points), by_chance);
      EXPECT_EQ(Mode::GLOBAL_GLOBAL, result.mode);
      EXPECT_EQ(result.transformation, result.alternatives.front().transformation);
      EXPECT_FALSE(result.device.empty());
      EXPECT_EQ("final ICP", result.seconds.back().stage);

      pcl::KSSICP<pcl::PointXYZ, pcl::PointXYZ, double> by_class;
      by_class.setSettings(settings);
      by_class.setInputSource(cloudOf<pcl::PointXYZ>(floatsOf(pair.source)));
      by_class.setInputTarget(cloudOf<pcl::PointXYZ>(floatsOf(pair.target)));
      pcl::PointCloud<pcl::PointXYZ> aligned;
      by_class.align(aligned);
      // both go by the same pairs of points: they differ by where they come to rest
      EXPECT_LT(squaredErrors(result, poseFrom(by_class), pair.source.points), 1.0);
      EXPECT_NEAR(confidenceOf(result.alternatives), by_class.getConfidence(), 0.02);
    }
}

TEST(CloudRegistration, LosesNothingFarFromTheOrigin)
{
  const CloudPair pair = pairOfClouds(randomRigid(1));
  CloudPair far = pair;
  const Eigen::Vector3d from(691e3, 5335e3, 500.0), to(-452e3, 5411e3, 100.0);
  far.source.points.colwise() += from;
  far.target.points.colwise() += to;
  Settings settings = quick();
  settings.estimate_scale = false;
  CloudRegistration registration(settings);
  const Registered near_by = registration.align(pair.source, pair.target);
  const Registered result = registration.align(far.source, far.target);
  ASSERT_EQ(FailureCause::NONE, result.failure.cause) << result.failure.reason;
  EXPECT_NEAR(rotationErrorDegrees(near_by.transformation, pair.truth),
              rotationErrorDegrees(result.transformation, pair.truth), 1e-3);
  const Eigen::Matrix3Xd placed =
      (result.transformation.topRows<3>() * far.source.points.colwise().homogeneous())
          .colwise() -
      to;
  const Eigen::Matrix3Xd expected =
      near_by.transformation.topRows<3>() * pair.source.points.colwise().homogeneous();
  EXPECT_LT((placed - expected).colwise().norm().maxCoeff(), 1e-4);
}

TEST(CloudRegistration, HeedsNormals)
{
  const Eigen::Vector3f half(1.0f, 0.6f, 0.3f);
  const Oriented a = orientedBox(half, 1500, 1), b = orientedBox(half, 1500, 2);
  Settings settings = quick();
  settings.estimate_scale = false;
  // of a box without its sides, only normals tell the top from the bottom
  const auto plate = [](const Oriented& whole, float side) {
    Cloud cloud;
    cloud.points.resize(3, whole.points.cols());
    cloud.normals.resize(3, whole.points.cols());
    Eigen::Index n = 0;
    for (Eigen::Index i = 0; i < whole.points.cols(); ++i)
      if (whole.normals(2, i) > 0.5f) {
        cloud.points.col(n) = whole.points.col(i).cast<double>();
        cloud.points(1, n) *= 1.0 + 0.5 * cloud.points(0, n);
        cloud.normals.col(n++) = Eigen::Vector3f(0.0f, 0.0f, 3.0f * side);
      }
    cloud.points.conservativeResize(3, n);
    cloud.normals.conservativeResize(3, n);
    return cloud;
  };
  CloudRegistration registration(settings);
  const Cloud source = plate(a, 1.0f);
  for (const float side : {1.0f, -1.0f}) {
    const Registered result = registration.align(source, plate(b, side));
    EXPECT_NEAR(side, result.transformation(2, 2), 0.01);
  }
}

TEST(CloudRegistration, LetsAGuessCompete)
{
  const CloudPair pair = pairOfClouds(randomRigid(2));
  CloudRegistration registration(quick());
  const StoredPose guess = pair.truth;
  const Registered result = registration.align(pair.source, pair.target, guess);
  EXPECT_EQ(FailureCause::NONE, result.failure.cause) << result.failure.reason;
  EXPECT_LT(rotationErrorDegrees(result.transformation, pair.truth), 1.0);

  StoredPose skewed = guess;
  skewed(0, 0) += 1.0;
  const Registered refused = registration.align(pair.source, pair.target, skewed);
  EXPECT_EQ(FailureCause::INPUT, refused.failure.cause);
  EXPECT_EQ("The guess is not a rotation, translation and positive scale.",
            refused.failure.reason);
  EXPECT_TRUE(refused.transformation.isIdentity(0.0));
  StoredPose away = guess;
  away(0, 3) = 1e9;
  const Registered far = registration.align(pair.source, pair.target, away);
  EXPECT_EQ(FailureCause::INPUT, far.failure.cause);
  EXPECT_EQ(away, far.transformation);
}

TEST(CloudRegistration, SaysWhatIsWrongWithACloud)
{
  const CloudPair pair = pairOfClouds(randomRigid(2));
  CloudRegistration registration(quick());
  const Cloud none{Eigen::Matrix3Xd(3, 0)};
  const Cloud nan{Eigen::Matrix3Xd::Constant(3, 9, std::nan(""))};
  Cloud mismatched = pair.source;
  mismatched.normals = Points::Ones(3, 7);
  for (const auto& [cloud, words] :
       {std::pair<Cloud, std::string>{none, "no finite points"},
        {nan, "no finite points"},
        {mismatched, "it has 1500 points and 7 normals"}}) {
    const Registered as_source = registration.align(cloud, pair.target);
    EXPECT_EQ(FailureCause::INPUT, as_source.failure.cause);
    EXPECT_NE(std::string::npos, as_source.failure.reason.find("The source cloud"));
    EXPECT_NE(std::string::npos, as_source.failure.reason.find(words))
        << as_source.failure.reason;
    EXPECT_TRUE(as_source.alternatives.empty());
    const Registered as_target = registration.align(pair.target, cloud);
    EXPECT_NE(std::string::npos, as_target.failure.reason.find("The target cloud"));
  }
  Cloud with_gaps = pair.source;
  with_gaps.points.col(7).setConstant(std::nan(""));
  with_gaps.points(1, 70) = std::numeric_limits<double>::infinity();
  with_gaps.points(2, 700) = 1e9;
  const Registered result = registration.align(with_gaps, pair.target);
  EXPECT_EQ(FailureCause::NONE, result.failure.cause) << result.failure.reason;
  EXPECT_EQ(1u, result.far_points.source);
  EXPECT_LT(rotationErrorDegrees(result.transformation, pair.truth), 1.0);
}

TEST(CloudRegistration, SaysWhatWouldFit)
{
  const CloudPair pair = pairOfClouds(randomRigid(3));
  Settings settings = quick();
  settings.estimate_scale = false;
  CloudRegistration registration(settings);
  Cloud image = pair.source;
  image.points.row(1) *= -1.0;
  const Registered mirrored = registration.align(image, pair.target);
  EXPECT_EQ(FailureCause::NO_FIT, mirrored.failure.cause);
  EXPECT_NE(std::string::npos, mirrored.failure.reason.find("mirror image"))
      << mirrored.failure.reason;
  Cloud large = pair.source;
  large.points *= 2.54;
  const Registered scaled = registration.align(large, pair.target);
  EXPECT_EQ(FailureCause::NO_FIT, scaled.failure.cause);
  EXPECT_NE(std::string::npos, scaled.failure.reason.find("but at 0.39"))
      << scaled.failure.reason;
}

TEST(CloudRegistration, GivesTheSameBitsAgainAndOnAnyNumberOfThreads)
{
  const CloudPair pair = pairOfClouds(randomSimilarity(4));
  CloudRegistration registration(quick());
  const Registered first = registration.align(pair.source, pair.target);
  registration.align(pair.target, pair.source);
  const Registered again = registration.align(pair.source, pair.target);
  EXPECT_EQ(first.transformation, again.transformation);
  EXPECT_EQ(first.precision.covariance, again.precision.covariance);
  Settings settings = quick();
  settings.threads = 3;
  EXPECT_EQ(first.transformation,
            CloudRegistration(settings).align(pair.source, pair.target).transformation);
}

TEST(CloudRegistration, EndsWhereItIsToldTo)
{
  const CloudPair pair = pairOfClouds(randomRigid(5));
  Settings settings = quick();
  std::atomic<CloudRegistration*> running{nullptr};
  settings.progress = [&](const std::string& stage, double) {
    if (stage == "search" && running)
      running.load()->cancel();
  };
  CloudRegistration cancelled(settings);
  running = &cancelled;
  const Registered result = cancelled.align(pair.source, pair.target);
  EXPECT_EQ(FailureCause::STOPPED, result.failure.cause);
  EXPECT_NE(std::string::npos, result.failure.reason.find("cancelled"));
  running = nullptr; // and the next one is not affected
  EXPECT_EQ(FailureCause::NONE,
            cancelled.align(pair.source, pair.target).failure.cause);

  settings.progress = [](const std::string&, double) { throw 1; };
  const Registered thrown = CloudRegistration(settings).align(pair.source, pair.target);
  EXPECT_EQ(FailureCause::OTHER, thrown.failure.cause);

  settings.progress = {};
  settings.time_limit = 1e-6;
  EXPECT_EQ(FailureCause::STOPPED,
            CloudRegistration(settings).align(pair.source, pair.target).failure.cause);
}

TEST(CloudRegistration, StillMovesWhereIterationsAreTooFew)
{
  const CloudPair pair = pairOfClouds(randomRigid(6));
  Settings settings = quick();
  settings.estimate_scale = false;
  CloudRegistration registration(settings);
  registration.setMaximumIterations(1);
  const Registered result = registration.align(pair.source, pair.target);
  EXPECT_EQ(1, result.iterations);
  EXPECT_EQ(FailureCause::UNSETTLED, result.failure.cause);
  EXPECT_NE(std::string::npos, result.failure.reason.find("after 1 iteration;"))
      << result.failure.reason;
  // one at least
  registration.setMaximumIterations(0);
  EXPECT_EQ(1, registration.align(pair.source, pair.target).iterations);
  registration.setMaximumIterations(300);
  const Registered settled = registration.align(pair.source, pair.target);
  EXPECT_EQ(FailureCause::NONE, settled.failure.cause) << settled.failure.reason;
  EXPECT_GT(settled.iterations, 1);
}

TEST(CloudRegistration, TakesThreePairsAtLeast)
{
  const CloudPair pair = pairOfClouds(randomRigid(6));
  Settings settings = quick();
  settings.icp_points = 2;
  const Registered result = CloudRegistration(settings).align(pair.source, pair.target);
  EXPECT_EQ(FailureCause::UNSETTLED, result.failure.cause);
  EXPECT_NE(std::string::npos, result.failure.reason.find("too few correspondences"))
      << result.failure.reason;
  EXPECT_TRUE(result.alternatives.empty());
}

TEST(CloudRegistration, TurnsUprightCloudsAboutTheirAxis)
{
  const CloudPair pair = pairOfClouds(
      similarity(Eigen::Quaterniond(Eigen::AngleAxisd(2.0, Eigen::Vector3d::UnitY())),
                 1.0, {3.0, 2.0, 1.0}));
  Settings settings = quick();
  settings.rotation_axis = RotationAxis::Y;
  const Registered result = CloudRegistration(settings).align(pair.source, pair.target);
  EXPECT_EQ(FailureCause::NONE, result.failure.cause) << result.failure.reason;
  const Eigen::Vector3d axis = result.transformation.block<3, 1>(0, 1);
  EXPECT_NEAR(1.0, axis.normalized().y(), 1e-12);
}

} // namespace
