/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include <pcl/registration/kss/detail/similarity.h>
#include <pcl/registration/kss/detail/surface_step.h>
#include <pcl/registration/kss/detail/surface_steps.h>

#include "poses.h"

#include <gtest/gtest.h>

#include <limits>

namespace {

using kss_test::randomVector;
using kss_test::similarity;
using pcl::kss::StoredPose;
using pcl::kss::SurfacePairs;
using pcl::kss::surfacePrecision;
using pcl::kss::SurfaceStep;
using pcl::kss::surfaceStep;
using pcl::kss::SurfaceStepSettings;

/** Pairs on an ellipsoid, whose source has been moved away by the inverse of a pose;
 * every other normal of either side points inwards. */
SurfacePairs
ellipsoidPairs(const Eigen::Vector3d& radii,
               const Eigen::Matrix4d& T_target_source,
               Eigen::Index size)
{
  std::mt19937 random(5);
  const Eigen::Affine3d back(T_target_source.inverse());
  const Eigen::Matrix3d turn = back.linear() / std::cbrt(back.linear().determinant());
  SurfacePairs pairs{Eigen::Matrix3Xd(3, size), Eigen::Matrix3Xd(3, size),
                     Eigen::Matrix3Xd(3, size), Eigen::Matrix3Xd(3, size)};
  for (Eigen::Index i = 0; i < size; ++i) {
    const Eigen::Vector3d unit =
        kss_test::randomRotation(random).toRotationMatrix().col(0);
    const Eigen::Vector3d place = radii.cwiseProduct(unit);
    const Eigen::Vector3d normal = unit.cwiseQuotient(radii).normalized();
    pairs.target.col(i) = place;
    pairs.source.col(i) = back * place;
    pairs.target_normals.col(i) = i % 2 ? normal : Eigen::Vector3d(-normal);
    pairs.source_normals.col(i) = turn * (i % 3 ? normal : Eigen::Vector3d(-normal));
  }
  return pairs;
}

SurfaceStepSettings
withScale()
{
  SurfaceStepSettings settings;
  settings.smallest_scale = 0.0;
  settings.largest_scale = std::numeric_limits<double>::infinity();
  return settings;
}

/** Steps until they have brought the source to the target. */
Eigen::Matrix4d
settled(SurfacePairs& pairs, const SurfaceStepSettings& settings)
{
  Eigen::Matrix4d pose = Eigen::Matrix4d::Identity();
  for (int steps = 0; steps < 10; ++steps) {
    const SurfaceStep step = surfaceStep(pairs, settings);
    EXPECT_TRUE(step.is_found);
    const Eigen::Affine3d moved(step.transformation);
    pairs.source = (moved * pairs.source).eval();
    pairs.source_normals =
        moved.linear() / std::cbrt(moved.linear().determinant()) * pairs.source_normals;
    pose = step.transformation * pose;
  }
  return pose;
}

const Eigen::Quaterniond
    small_turn(Eigen::AngleAxisd(0.05, Eigen::Vector3d(1.0, -2.0, 0.5).normalized()));
const Eigen::Vector3d uneven(1.0, 0.7, 0.4);

TEST(SurfaceStep, RecoversARigidMotion)
{
  const Eigen::Matrix4d pose = similarity(small_turn, 1.0, {0.02, -0.03, 0.01});
  SurfacePairs pairs = ellipsoidPairs(uneven, pose, 500);
  EXPECT_TRUE(settled(pairs, {}).isApprox(pose, 1e-9));
}

TEST(SurfaceStep, RecoversAScale)
{
  const Eigen::Matrix4d pose = similarity(small_turn, 1.04, {0.02, -0.03, 0.01});
  SurfacePairs pairs = ellipsoidPairs(uneven, pose, 500);
  EXPECT_TRUE(settled(pairs, withScale()).isApprox(pose, 1e-9));
}

TEST(SurfaceStep, IsRigidWhereTheScaleIsKnown)
{
  const Eigen::Matrix4d pose = similarity(small_turn, 1.04, {0.02, -0.03, 0.01});
  const SurfaceStep step = surfaceStep(ellipsoidPairs(uneven, pose, 500), {});
  ASSERT_TRUE(step.is_found);
  EXPECT_NEAR(pcl::kss::scaleOf(step.transformation), 1.0, 1e-12);
}

TEST(SurfaceStep, StaysWithinTheBoundsOfTheScale)
{
  const Eigen::Matrix4d pose = similarity(small_turn, 1.04, {0.02, -0.03, 0.01});
  SurfaceStepSettings settings = withScale();
  settings.largest_scale = 1.01;
  const SurfaceStep step = surfaceStep(ellipsoidPairs(uneven, pose, 500), settings);
  ASSERT_TRUE(step.is_found);
  EXPECT_NEAR(pcl::kss::scaleOf(step.transformation), 1.01, 1e-9);
}

/** A fifth of the pairs is far off, all on one side. */
TEST(SurfaceStep, GivesNoSayToPairsWithoutCounterpart)
{
  const Eigen::Matrix4d pose = similarity(small_turn, 1.01, {0.02, -0.03, 0.01});
  SurfacePairs pairs = ellipsoidPairs(uneven, pose, 500);
  for (Eigen::Index i = 0; i < 500; i += 5)
    pairs.source.col(i) += 0.3 * Eigen::Vector3d(1.0, 1.0, 1.0);
  EXPECT_TRUE(settled(pairs, withScale()).isApprox(pose, 1e-6));
}

TEST(SurfaceStep, DoesNotMoveAlongWhatIsNotDetermined)
{
  const Eigen::Vector3d shift(0.02, -0.03, 0.01);
  const Eigen::Matrix4d pose = similarity(small_turn, 1.0, shift);
  const Eigen::Vector3d ball(1.0, 1.0, 1.0);
  const SurfaceStep step = surfaceStep(ellipsoidPairs(ball, pose, 500), {});
  ASSERT_TRUE(step.is_found);
  EXPECT_EQ(step.undetermined, 3);
  const Eigen::Affine3d moved(step.transformation);
  EXPECT_LT(Eigen::AngleAxisd(moved.rotation()).angle(), 0.1 * 0.05);
  EXPECT_EQ(surfaceStep(ellipsoidPairs(uneven, pose, 500), {}).undetermined, 0);
  EXPECT_EQ(surfacePrecision(ellipsoidPairs(ball, pose, 500), {}, shift).undetermined,
            3);
}

/** However many points there are: they share the errors of a rounded pose. */
TEST(SurfaceStep, IsAtRestWhereItMovesByNoMoreThanRounding)
{
  SurfaceStepSettings settings;
  settings.rounding_error = 1e-6;
  const auto moved = [&](double distance, Eigen::Index size) {
    Eigen::Matrix4d pose = Eigen::Matrix4d::Identity();
    pose(0, 3) = distance;
    return surfaceStep(ellipsoidPairs(uneven, pose, size), settings)
        .squared_errors_moved;
  };
  for (const Eigen::Index size : {500, 20000}) {
    EXPECT_LT(moved(1e-7, size), 0.01) << size;
    EXPECT_GT(moved(1e-5, size), 1.0) << size;
  }
}

TEST(SurfaceStep, FindsNothingInFewPairsOrInNormalsThatSayNothing)
{
  const Eigen::Matrix4d pose = similarity(small_turn, 1.0, {0.02, -0.03, 0.01});
  EXPECT_FALSE(surfaceStep(ellipsoidPairs(uneven, pose, 13), {}).is_found);
  EXPECT_FALSE(surfaceStep(ellipsoidPairs(uneven, pose, 0), {}).is_found);
  SurfacePairs pairs = ellipsoidPairs(uneven, pose, 500);
  std::mt19937 random(7);
  for (Eigen::Index i = 0; i < 500; ++i)
    pairs.source_normals.col(i) = randomVector(random, 1.0).normalized();
  SurfaceStepSettings settings;
  settings.source_normal_error = 1.0;
  EXPECT_FALSE(surfaceStep(pairs, settings).is_found);
}

TEST(SurfaceSteps, TurnsUprightWhatSomebodyElseHasFound)
{
  SurfaceStepSettings settings;
  settings.rotation_axis = pcl::kss::RotationAxis::Z;
  pcl::kss::SurfaceSteps steps;
  steps.start(Eigen::Matrix4d::Identity(), settings);
  pcl::kss::Matches matches;
  std::mt19937 random(2);
  matches.source.resize(3, 5);
  for (int i = 0; i < 5; ++i)
    matches.source.col(i) = randomVector(random, 1.0);
  const Eigen::Vector3d middle = matches.source.rowwise().mean();
  const StoredPose tilted = similarity(small_turn, 1.0, {0.1, 0.2, 0.3});
  const StoredPose taken = steps.taken(tilted, matches);
  EXPECT_NEAR(1.0, taken(2, 2), 1e-12);
  EXPECT_TRUE((taken * middle.homogeneous()).isApprox(tilted * middle.homogeneous()));
  settings.rotation_axis = pcl::kss::RotationAxis::ANY;
  steps.start(Eigen::Matrix4d::Identity(), settings);
  EXPECT_EQ(tilted, steps.taken(tilted, matches));
}

TEST(SurfaceStep, TurnsAboutTheAxisAlone)
{
  const Eigen::Matrix4d truth =
      similarity(Eigen::Quaterniond(Eigen::AngleAxisd(0.06, Eigen::Vector3d::UnitY())),
                 1.02, {0.01, -0.02, 0.03});
  SurfaceStepSettings settings = withScale();
  settings.rotation_axis = pcl::kss::RotationAxis::Y;
  SurfacePairs pairs = ellipsoidPairs(uneven, truth, 400);
  EXPECT_LT((settled(pairs, settings) - truth).cwiseAbs().maxCoeff(), 1e-6);
  // what is tilted stays tilted, and nothing of it is doubtful
  SurfacePairs tilted =
      ellipsoidPairs(uneven, similarity(small_turn, 1.0, {0.0, 0.0, 0.0}), 400);
  const Eigen::Matrix4d pose = settled(tilted, settings);
  EXPECT_NEAR(1.0, pose.col(1).head<3>().normalized().y(), 1e-12);
  const auto precision = surfacePrecision(tilted, settings, Eigen::Vector3d::Zero());
  EXPECT_EQ(7, precision.unknowns);
  EXPECT_EQ(0.0, precision.covariance(0, 0));
  EXPECT_GT(precision.covariance(1, 1), 0.0);
  EXPECT_EQ(0.0, precision.covariance(2, 2));
}

} // namespace
