/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "poses.h"

#include "geometry/turns.h"

#include <gtest/gtest.h>

namespace {

using namespace kss_test;
using namespace pcl::kss;

const RotationAxis single_axes[] = {RotationAxis::X, RotationAxis::Y, RotationAxis::Z};

TEST(Turns, AreAboutOneAxisOrAll)
{
  EXPECT_EQ(Eigen::Matrix3d::Identity(), Eigen::Matrix3d(turnsOf(RotationAxis::ANY)));
  for (int i = 0; i < 3; ++i) {
    ASSERT_EQ(1, turnsOf(single_axes[i]).cols());
    EXPECT_EQ(Eigen::Vector3d::Unit(i), Eigen::Vector3d(turnsOf(single_axes[i])));
  }
}

TEST(Turns, NearestRotationHasTheLargestTraceOfThoseAboutTheAxis)
{
  std::mt19937 random(3);
  for (int trial = 0; trial < 20; ++trial) {
    // what points and their counterparts sum up to: any matrix
    Eigen::Matrix3d matrix;
    for (int i = 0; i < 3; ++i)
      matrix.col(i) = randomVector(random, 1.0);
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector3d axis = Eigen::Vector3d::Unit(i);
      const Eigen::Matrix3d found = nearestRotation(matrix, single_axes[i]);
      EXPECT_TRUE(found.isUnitary(1e-12));
      EXPECT_TRUE((found * axis).isApprox(axis, 1e-12));
      const double trace = (found.transpose() * matrix).trace();
      for (double angle = 0.0; angle < 6.3; angle += 0.01)
        EXPECT_GE(
            trace + 1e-9,
            (Eigen::AngleAxisd(angle, axis).toRotationMatrix().transpose() * matrix)
                .trace());
    }
    const Eigen::Matrix3d any = nearestRotation(matrix, RotationAxis::ANY);
    EXPECT_GT(any.determinant(), 0.0);
    for (int other = 0; other < 100; ++other)
      EXPECT_GE(
          (any.transpose() * matrix).trace() + 1e-9,
          (randomRotation(random).toRotationMatrix().transpose() * matrix).trace());
  }
}

TEST(Turns, ATiltedPoseIsTurnedUprightAboutAPoint)
{
  const Eigen::Quaterniond upright(Eigen::AngleAxisd(2.0, Eigen::Vector3d::UnitZ()));
  const Eigen::Quaterniond tilt(Eigen::AngleAxisd(0.2, Eigen::Vector3d::UnitX()));
  const Eigen::Vector3d point(1.0, 2.0, 3.0);
  const StoredPose tilted = similarity(tilt * upright, 1.5, {4.0, 5.0, 6.0});
  const StoredPose turned = turnedAbout(RotationAxis::Z, tilted, point);
  EXPECT_TRUE((turned * point.homogeneous()).isApprox(tilted * point.homogeneous()));
  const Eigen::Matrix3d linear = turned.topLeftCorner<3, 3>();
  EXPECT_NEAR(1.5, std::cbrt(linear.determinant()), 1e-12);
  EXPECT_TRUE((linear * Eigen::Vector3d::UnitZ())
                  .isApprox(1.5 * Eigen::Vector3d::UnitZ(), 1e-12));
  EXPECT_TRUE(linear.isApprox(1.5 * upright.toRotationMatrix(), 0.05));
  // what is upright stays, and so does everything where any axis will do
  EXPECT_TRUE(turnedAbout(RotationAxis::Z, turned, point).isApprox(turned, 1e-12));
  EXPECT_EQ(tilted, turnedAbout(RotationAxis::ANY, tilted, point));
}

} // namespace
