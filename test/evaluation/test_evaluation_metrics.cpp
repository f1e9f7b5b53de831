/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "evaluation_cases.h"
#include "poses.h"

#include "metrics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace evaluation;
using namespace kss_test;

namespace {

class EvaluationMetrics : public FolderTest {
protected:
  Case
  caseOf(const Mesh& mesh, const std::string& condition = "similarity") const
  {
    return makeCase(surfaceOf(folder, mesh), "model",
                    conditionOf(condition, 1500, Protocol()), 0, Protocol());
  }
};

Eigen::Vector3d
middleOf(const Case& work)
{
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const auto& point : placedSource(work))
    middle += point / static_cast<double>(work.source->size());
  return middle;
}

Eigen::Matrix4d
shift(const Eigen::Vector3d& by)
{
  return similarity(Eigen::Quaterniond::Identity(), 1.0, by);
}

/** The true pose, then a similarity about a point. */
Eigen::Matrix4d
about(const Eigen::Vector3d& center, const Eigen::Matrix4d& change, const Case& work)
{
  return shift(center) * change * shift(-center) * work.truth;
}

/** The true pose, then a similarity about the middle of the source. */
Eigen::Matrix4d
off(const Eigen::Matrix4d& change, const Case& work)
{
  return about(middleOf(work), change, work);
}

Eigen::Matrix4d
scaling(double factor)
{
  return similarity(Eigen::Quaterniond::Identity(), factor, Eigen::Vector3d::Zero());
}

/** Models are centred at the origin. */
bool
solvedIfTurned(const Case& work, double degrees, const Eigen::Vector3d& axis)
{
  return metricsOf(work, turn(degrees, axis) * work.truth).solved;
}

std::vector<double>
numbersOf(const Metrics& metrics)
{
  return {metrics.distance.mse,
          metrics.distance.rmse,
          metrics.distance.mae,
          metrics.angle.mse,
          metrics.angle.rmse,
          metrics.angle.mae,
          metrics.rotation_degrees,
          metrics.translation,
          metrics.scale,
          metrics.target_registration_error};
}

const Eigen::Vector3d x = Eigen::Vector3d::UnitX(), y = Eigen::Vector3d::UnitY(),
                      z = Eigen::Vector3d::UnitZ();

} // namespace

TEST_F(EvaluationMetrics, TruePoseIsSolved)
{
  for (const char* condition : {"similarity", "density", "gauss-0.66", "deleted-0.3"}) {
    const Case work = caseOf(creature(), condition);
    const Metrics metrics = metricsOf(work, work.truth);
    EXPECT_TRUE(metrics.solved) << condition;
    EXPECT_NEAR(0.0, metrics.rotation_degrees, 1e-6);
    EXPECT_NEAR(0.0, metrics.translation, 1e-12);
    EXPECT_NEAR(0.0, metrics.scale, 1e-12);
    EXPECT_NEAR(0.0, metrics.target_registration_error, 1e-12);
    // the distance between two samplings
    EXPECT_LT(metrics.distance.rmse, 0.03);
    EXPECT_GT(metrics.distance.rmse, 0.001);
  }
}

TEST_F(EvaluationMetrics, AreWhatTheNearestPointsTell)
{
  const Case work = caseOf(creature());
  const Eigen::Matrix4d pose = off(turn(20.0, {1, 2, 3}) * scaling(1.1), work);
  const Eigen::Matrix3d rotation =
      turn(20.0, {1, 2, 3}).topLeftCorner<3, 3>() *
      Eigen::Matrix3d(work.truth.topLeftCorner<3, 3>() / scaleIn(work.truth));
  const auto target = positionsOf(*work.target);
  Eigen::AlignedBox3d bounds;
  for (const auto& point : target)
    bounds.extend(point);
  const double diagonal = bounds.diagonal().norm();

  const double n = static_cast<double>(work.source->size());
  double distance = 0.0, squared = 0.0, angle = 0.0, squared_angle = 0.0;
  for (std::size_t i = 0; i < work.source->size(); ++i) {
    const Eigen::Vector3d p =
        Eigen::Affine3d(pose) * (*work.source)[i].getVector3fMap().cast<double>();
    std::size_t nearest = 0;
    for (std::size_t j = 0; j < target.size(); ++j)
      if ((target[j] - p).norm() < (target[nearest] - p).norm())
        nearest = j;
    const double d = (target[nearest] - p).norm() / diagonal;
    distance += d / n;
    squared += d * d / n;
    const double cosine = (rotation * work.source_normals[i].cast<double>())
                              .dot(work.target_normals[nearest].cast<double>());
    const double a = std::acos(std::min(1.0, std::abs(cosine)));
    angle += a / n;
    squared_angle += a * a / n;
  }
  const Metrics metrics = metricsOf(work, pose);
  EXPECT_NEAR(distance, metrics.distance.mae, 1e-6);
  EXPECT_NEAR(squared, metrics.distance.mse, 1e-6 * squared);
  EXPECT_NEAR(angle, metrics.angle.mae, 1e-3);
  EXPECT_NEAR(squared_angle, metrics.angle.mse, 1e-3);
}

TEST_F(EvaluationMetrics, MeansAreConsistent)
{
  const Case work = caseOf(creature());
  for (const double degrees : {0.0, 3.0, 120.0}) {
    const Metrics metrics = metricsOf(work, off(turn(degrees, y), work));
    for (const Errors& errors : {metrics.distance, metrics.angle}) {
      EXPECT_NEAR(errors.rmse * errors.rmse, errors.mse, 1e-12);
      EXPECT_LT(errors.mae, errors.rmse);
      EXPECT_GT(errors.mae, 0.0);
    }
  }
}

TEST_F(EvaluationMetrics, NameTheRotation)
{
  const Case work = caseOf(creature());
  for (const double degrees : {3.0, 4.9, 7.0, 90.0, 179.0, 270.0}) {
    const Metrics metrics = metricsOf(work, off(turn(degrees, {2, -1, 3}), work));
    EXPECT_NEAR(std::min(degrees, 360.0 - degrees), metrics.rotation_degrees, 1e-6);
    EXPECT_NEAR(0.0, metrics.translation, 1e-6);
    EXPECT_NEAR(0.0, metrics.scale, 1e-9);
    EXPECT_GT(metrics.target_registration_error, 0.003);
    EXPECT_EQ(degrees < 5.0, metrics.solved) << degrees;
  }
}

TEST_F(EvaluationMetrics, NameTheTranslation)
{
  const Case work = caseOf(creature());
  for (const double share : {0.03, 0.049, 0.06, 0.5}) {
    const Eigen::Vector3d by = share * work.diagonal * Eigen::Vector3d(1, 2, 2) / 3.0;
    const Metrics metrics = metricsOf(work, shift(by) * work.truth);
    EXPECT_NEAR(share, metrics.translation, 1e-9);
    EXPECT_NEAR(share, metrics.target_registration_error, 1e-9);
    EXPECT_NEAR(0.0, metrics.rotation_degrees, 1e-6);
    EXPECT_EQ(share < 0.05, metrics.solved) << share;
  }
}

TEST_F(EvaluationMetrics, NameTheScale)
{
  const Case work = caseOf(creature());
  for (const double factor : {1.03, 0.96, 1.049, 1.06, 0.94, 2.0}) {
    const Metrics metrics = metricsOf(work, off(scaling(factor), work));
    EXPECT_NEAR(std::abs(factor - 1.0), metrics.scale, 1e-9);
    EXPECT_NEAR(0.0, metrics.translation, 1e-6);
    EXPECT_NEAR(0.0, metrics.rotation_degrees, 1e-6);
    EXPECT_EQ(std::abs(factor - 1.0) < 0.05, metrics.solved) << factor;
  }
}

TEST_F(EvaluationMetrics, RegistrationErrorIsThatOfThePoints)
{
  const Case work = caseOf(creature(), "deleted-0.3");
  const Eigen::Matrix4d pose = off(turn(40.0, {1, 1, 0}) * scaling(0.9), work);
  double squares = 0.0;
  for (const auto& p : positionsOf(*work.source))
    squares +=
        (Eigen::Affine3d(pose) * p - Eigen::Affine3d(work.truth) * p).squaredNorm() /
        static_cast<double>(work.source->size());
  EXPECT_NEAR(std::sqrt(squares) / work.diagonal,
              metricsOf(work, pose).target_registration_error, 1e-9);
}

TEST_F(EvaluationMetrics, SymmetricModelsMayBeTurned)
{
  const Case cube = caseOf(box({0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}));
  for (const auto& axis : {x, y, z}) {
    EXPECT_TRUE(solvedIfTurned(cube, 90.0, axis));
    EXPECT_FALSE(solvedIfTurned(cube, 45.0, axis));
  }
  EXPECT_TRUE(solvedIfTurned(cube, 120.0, {1, 1, 1}));
  EXPECT_NEAR(90.0, metricsOf(cube, turn(90.0, x) * cube.truth).rotation_degrees, 1e-6);

  const Case bar = caseOf(box({0.0, 0.0, 0.0}, {1.0, 0.5, 0.3}));
  for (const auto& axis : {x, y, z}) {
    EXPECT_TRUE(solvedIfTurned(bar, 180.0, axis));
    EXPECT_FALSE(solvedIfTurned(bar, 90.0, axis));
  }
  const Case ball = caseOf(ellipsoid({0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}));
  EXPECT_TRUE(solvedIfTurned(ball, 77.0, {1, 2, 3}));
}

TEST_F(EvaluationMetrics, OthersMayNot)
{
  for (const Mesh& mesh : {creature(), lump()}) {
    const Case work = caseOf(mesh);
    for (const auto& axis : {x, y, z})
      for (const double degrees : {10.0, 90.0, 180.0})
        EXPECT_FALSE(solvedIfTurned(work, degrees, axis));
  }
}

TEST_F(EvaluationMetrics, SymmetryExcusesNothingElse)
{
  const Case cube = caseOf(box({0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}));
  EXPECT_FALSE(metricsOf(cube, shift(0.1 * x) * turn(90.0, x) * cube.truth).solved);
  EXPECT_FALSE(metricsOf(cube, scaling(0.9) * turn(90.0, x) * cube.truth).solved);
}

TEST_F(EvaluationMetrics, OfAPartAskTheWholeModel)
{
  const Case cube = caseOf(box({0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}), "deleted-0.3");
  EXPECT_TRUE(solvedIfTurned(cube, 90.0, y));
  // its middle is elsewhere
  EXPECT_GT(middleOf(cube).norm(), 0.05);
  const Case other = caseOf(creature(), "deleted-0.3");
  EXPECT_FALSE(solvedIfTurned(other, 180.0, y));
}

TEST_F(EvaluationMetrics, NormalsMayPointToEitherSide)
{
  const Case work = caseOf(creature());
  Case flipped = work;
  for (auto& normal : flipped.source_normals)
    normal = -normal;
  for (std::size_t i = 0; i < flipped.target_normals.size(); i += 3)
    flipped.target_normals[i] *= -1.0f;
  for (const double degrees : {0.0, 70.0, 180.0}) {
    const Eigen::Matrix4d pose = off(turn(degrees, x), work);
    EXPECT_EQ(numbersOf(metricsOf(work, pose)), numbersOf(metricsOf(flipped, pose)));
    EXPECT_LT(metricsOf(work, pose).angle.rmse, M_PI / 2.0);
  }
}

TEST_F(EvaluationMetrics, AnglesAreThoseOfTheNormals)
{
  // a flat model: the turn alone
  const Case work = caseOf(pennant());
  for (const double degrees : {30.0, 80.0}) {
    const Errors angle = metricsOf(work, off(turn(degrees, y), work)).angle;
    EXPECT_NEAR(degrees * M_PI / 180.0, angle.mae, 1e-3);
    EXPECT_NEAR(degrees * M_PI / 180.0, angle.rmse, 1e-3);
  }
  EXPECT_NEAR(M_PI / 6.0, metricsOf(work, off(turn(150.0, y), work)).angle.mae, 1e-3);
}

TEST_F(EvaluationMetrics, WhatIsNoSimilarityIsNotSolved)
{
  const Case work = caseOf(creature());
  const auto unmoved = numbersOf(metricsOf(work, Eigen::Matrix4d::Identity()));
  std::vector<Eigen::Matrix4d> poses(7, work.truth);
  poses[0](1, 3) = std::numeric_limits<double>::quiet_NaN();
  poses[1](0, 0) = std::numeric_limits<double>::infinity();
  poses[2].col(0) *= -1.0; // a reflection
  poses[3].setZero();
  poses[4](0, 3) = 1e20;                    // the square of that is no float
  poses[5](2, 3) = 1e200;                   // nor is that
  poses[6].row(0) += 0.1 * poses[6].row(1); // a shear
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Metrics metrics = metricsOf(work, poses[i]);
    EXPECT_FALSE(metrics.solved) << i;
    EXPECT_EQ(unmoved, numbersOf(metrics)) << i;
  }
  for (const double number : unmoved)
    EXPECT_TRUE(std::isfinite(number));
}

TEST_F(EvaluationMetrics, ReflectedModelsAreNotSolved)
{
  // its own mirror image, that is
  const Case work = caseOf(box({0.0, 0.0, 0.0}, {1.0, 0.5, 0.3}));
  Eigen::Matrix4d reflection = Eigen::Matrix4d::Identity();
  reflection(0, 0) = -1.0;
  EXPECT_FALSE(metricsOf(work, reflection * work.truth).solved);
}

TEST_F(EvaluationMetrics, DoNotDependOnTheUnit)
{
  for (const Mesh& mesh : {creature(), box({0.0, 0.0, 0.0}, {1.0, 1.0, 1.0})}) {
    const Case metres = caseOf(mesh);
    Case millimetres = metres;
    const auto enlarged = [](const Cloud& cloud) {
      auto result = pcl::make_shared<Cloud>(cloud);
      for (auto& point : *result)
        point.getVector3fMap() *= 1000.0f;
      return result;
    };
    millimetres.target = enlarged(*metres.target);
    millimetres.whole = enlarged(*metres.whole);
    millimetres.whole_again = enlarged(*metres.whole_again);
    millimetres.diagonal *= 1000.0;
    millimetres.truth = scaling(1000.0) * metres.truth;
    for (const double degrees : {3.0, 8.0, 90.0}) {
      const Eigen::Matrix4d change = turn(degrees, x) * shift(0.01 * y);
      const Metrics expected = metricsOf(metres, change * metres.truth);
      const Metrics found =
          metricsOf(millimetres, scaling(1000.0) * change * metres.truth);
      const auto numbers = numbersOf(found), expected_numbers = numbersOf(expected);
      for (std::size_t i = 0; i < numbers.size(); ++i)
        EXPECT_NEAR(expected_numbers[i], numbers[i], 1e-3 * expected_numbers[i] + 1e-6)
            << degrees << ' ' << i;
      EXPECT_EQ(expected.solved, found.solved) << degrees;
    }
  }
}

TEST_F(EvaluationMetrics, TargetsDiagonalIsOne)
{
  const Case work = caseOf(creature());
  // far away, the distance to the target is that to any of its points
  const double away = 1000.0;
  const Metrics metrics = metricsOf(work, shift(away * work.diagonal * x) * work.truth);
  EXPECT_NEAR(away, metrics.distance.mae, 1.0);
  EXPECT_NEAR(away, metrics.translation, 1e-6);
}
