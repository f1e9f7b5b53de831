/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "shapes.h"

#include <Eigen/Geometry>

#include <cmath>
#include <random>

namespace kss_test {

inline Eigen::Quaterniond
randomRotation(std::mt19937& random)
{
  std::normal_distribution<double> normal;
  Eigen::Quaterniond q(normal(random), normal(random), normal(random), normal(random));
  return q.normalized();
}

inline Eigen::Vector3d
randomVector(std::mt19937& random, double largest)
{
  std::uniform_real_distribution<double> entry(-largest, largest);
  return {entry(random), entry(random), entry(random)};
}

inline Eigen::Matrix4d
similarity(const Eigen::Quaterniond& rotation,
           double scale,
           const Eigen::Vector3d& translation)
{
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
  matrix.topLeftCorner<3, 3>() = scale * rotation.toRotationMatrix();
  matrix.topRightCorner<3, 1>() = translation;
  return matrix;
}

/** \brief Any rotation, a scale in [0.5, 2], a shift of up to five units. */
inline Eigen::Matrix4d
randomSimilarity(unsigned int seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> exponent(-1.0, 1.0);
  const Eigen::Quaterniond rotation = randomRotation(random);
  const double scale = std::exp2(exponent(random));
  return similarity(rotation, scale, randomVector(random, 5.0));
}

/** \brief The same without scale. */
inline Eigen::Matrix4d
randomRigid(unsigned int seed)
{
  std::mt19937 random(seed);
  const Eigen::Quaterniond rotation = randomRotation(random);
  return similarity(rotation, 1.0, randomVector(random, 5.0));
}

inline Eigen::Matrix4d
turn(double degrees, const Eigen::Vector3d& axis)
{
  return similarity(
      Eigen::Quaterniond(Eigen::AngleAxisd(degrees * M_PI / 180.0, axis.normalized())),
      1.0, Eigen::Vector3d::Zero());
}

inline Points
transformed(const Points& points, const Eigen::Matrix4d& matrix)
{
  return (matrix.topRows<3>() * points.cast<double>().colwise().homogeneous())
      .cast<float>();
}

inline double
scaleIn(const Eigen::Matrix4d& matrix)
{
  return matrix.topLeftCorner<3, 1>().norm();
}

inline double
rotationErrorDegrees(const Eigen::Matrix4d& a, const Eigen::Matrix4d& b)
{
  const Eigen::Quaterniond p(Eigen::Matrix3d(a.topLeftCorner<3, 3>() / scaleIn(a)));
  const Eigen::Quaterniond q(Eigen::Matrix3d(b.topLeftCorner<3, 3>() / scaleIn(b)));
  return p.angularDistance(q) * 180.0 / M_PI;
}

/** \brief How far apart two poses place the points, root mean square, as a share of the
 * diagonal of the cloud that the second one places. */
inline double
displacement(const Eigen::Matrix4d& pose,
             const Eigen::Matrix4d& truth,
             const Points& points)
{
  const Eigen::Matrix3Xd apart =
      (pose - truth).topRows<3>() * points.cast<double>().colwise().homogeneous();
  return apart.norm() / std::sqrt(static_cast<double>(points.cols())) /
         (scaleIn(truth) * diagonalOf(points));
}

} // namespace kss_test
