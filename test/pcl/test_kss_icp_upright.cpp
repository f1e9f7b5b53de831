/*
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * What KSSICP finds where the rotation is about one axis.
 */

#include "trial.h"

#include <functional>
#include <string>

namespace {

using namespace kss_test;
using pcl::kss::RotationAxis;

const RotationAxis axes[] = {RotationAxis::X, RotationAxis::Y, RotationAxis::Z};

Eigen::Matrix4d
turnAbout(int axis, double angle, double scale = 1.0)
{
  return similarity(
      Eigen::Quaterniond(Eigen::AngleAxisd(angle, Eigen::Vector3d::Unit(axis))), scale,
      {0.5, -1.0, 2.0});
}

/** How far an axis is tilted, in radians. */
double
tiltOf(const Eigen::Matrix4f& transformation, int axis)
{
  const Eigen::Vector3d placed =
      transformation.cast<double>().topLeftCorner<3, 3>().col(axis);
  return std::acos(std::min(1.0, placed.normalized()[axis]));
}

TEST(KSSICP, UprightCloudsTurnAboutTheirAxisAlone)
{
  for (int axis = 0; axis < 3; ++axis)
    for (const double angle : {0.1, 2.0, -2.9}) {
      const auto pair = pairOf(turnAbout(axis, angle, 1.3), 7);
      Trial trial(pair);
      trial.registration.setRotationAxis(axes[axis]);
      const Eigen::Matrix4f found = trial.align();
      EXPECT_TRUE(trial.registration.hasConverged());
      expectRight(trial.registration, pair);
      EXPECT_LT(tiltOf(found, axis), 1e-6);
      // nothing is doubtful about what is known
      const Eigen::MatrixXd covariance = trial.registration.getCovariance();
      ASSERT_GE(covariance.rows(), 6);
      for (int other = 0; other < 3; ++other)
        EXPECT_EQ(other == axis, covariance(other, other) > 0.0);
    }
}

TEST(KSSICP, UprightCloudsAreFoundInAnyWay)
{
  using pcl::kss::Settings;
  const auto pair = pairOf(turnAbout(2, 2.2), 8);
  const std::function<void(Settings&)> ways[] = {
      [](Settings& s) { s.rotation_set = pcl::kss::RotationSet::EULER; },
      [](Settings& s) { s.search = pcl::kss::Search::EXACT; },
      [](Settings& s) { s = pcl::kss::paperSettings(s); },
      [](Settings& s) { s.mode = pcl::kss::Mode::PARTIAL_PARTIAL; },
      [](Settings& s) {
        s.mode = pcl::kss::Mode::IN_SCENE;
        s.estimate_scale = false;
      }};
  for (const auto& way : ways) {
    Trial trial(pair);
    Settings settings = trial.registration.getSettings();
    settings.rotation_axis = RotationAxis::Z;
    way(settings);
    trial.registration.setSettings(settings);
    EXPECT_LT(tiltOf(trial.align(), 2), 1e-6) << &way - ways;
    expectRight(trial.registration, pair);
  }
}

TEST(KSSICP, MirrorImagesOfUprightCloudsAreTold)
{
  for (int axis = 0; axis < 3; ++axis)
    for (int flipped = 0; flipped < 3; ++flipped) {
      auto pair = pairOf(turnAbout(axis, 1.0), 11);
      for (pcl::PointXYZ& point : *pair.source)
        point.getVector3fMap()[flipped] *= -1.0f;
      Trial trial(pair);
      trial.registration.setRotationAxis(axes[axis]);
      trial.align();
      EXPECT_FALSE(trial.registration.hasConverged());
      EXPECT_NE(std::string::npos,
                trial.registration.getFailureReason().find("mirror image"))
          << axis << ", " << flipped << ": " << trial.registration.getFailureReason();
    }
}

TEST(KSSICP, ATiltedCloudIsNotForcedUpright)
{
  // the right pose is not among those that may be: there is none that fits as well
  const auto pair = pairOf(
      similarity(Eigen::Quaterniond(Eigen::AngleAxisd(0.7, Eigen::Vector3d::UnitX())),
                 1.0, {0.0, 0.0, 0.0}),
      9);
  Trial trial(pair);
  trial.registration.setRotationAxis(RotationAxis::Z);
  trial.align();
  EXPECT_FALSE(trial.registration.hasConverged());
  trial.registration.setRotationAxis(RotationAxis::ANY);
  trial.align();
  EXPECT_TRUE(trial.registration.hasConverged());
  expectRight(trial.registration, pair);
}

TEST(KSSICP, AGuessIsTurnedUpright)
{
  const auto pair = pairOf(turnAbout(1, 1.0), 10);
  Trial trial(pair);
  trial.registration.setRotationAxis(RotationAxis::Y);
  const Eigen::Matrix4d tilt =
      similarity(Eigen::Quaterniond(Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitX())),
                 1.0, {0.0, 0.0, 0.0});
  EXPECT_LT(tiltOf(trial.align(Eigen::Matrix4d(tilt * pair.truth)), 1), 1e-6);
  expectRight(trial.registration, pair);
}

} // namespace
