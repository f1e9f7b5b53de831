/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "geometry/turns.h"

#include <pcl/registration/kss/detail/similarity.h>

#include <Eigen/Geometry>
#include <Eigen/SVD>

#include <cmath>

namespace pcl {
namespace kss {

Turns
turnsOf(RotationAxis axis)
{
  switch (axis) {
  case RotationAxis::X:
    return Eigen::Vector3d::UnitX();
  case RotationAxis::Y:
    return Eigen::Vector3d::UnitY();
  case RotationAxis::Z:
    return Eigen::Vector3d::UnitZ();
  case RotationAxis::ANY:
    break;
  }
  return Eigen::Matrix3d::Identity();
}

Eigen::Matrix3d
nearestRotation(const Eigen::Matrix3d& matrix, RotationAxis axis)
{
  if (axis == RotationAxis::ANY) {
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(matrix, Eigen::ComputeFullU |
                                                            Eigen::ComputeFullV);
    const Eigen::Matrix3d& u = svd.matrixU();
    const Eigen::Matrix3d& v = svd.matrixV();
    const Eigen::Vector3d signs(1.0, 1.0,
                                (u * v.transpose()).determinant() < 0 ? -1 : 1);
    return u * signs.asDiagonal() * v.transpose();
  }
  // R = a a' + cos (I - a a') + sin [a]x: the trace has its maximum where cos and sin
  // are as their factors
  const Eigen::Vector3d a = turnsOf(axis).col(0);
  const Eigen::Vector3d turned(matrix(2, 1) - matrix(1, 2), matrix(0, 2) - matrix(2, 0),
                               matrix(1, 0) - matrix(0, 1));
  const double angle = std::atan2(a.dot(turned), matrix.trace() - a.dot(matrix * a));
  return Eigen::AngleAxisd(angle, a).toRotationMatrix();
}

StoredPose
turnedAbout(RotationAxis axis,
            const StoredPose& similarity,
            const Eigen::Vector3d& point)
{
  if (axis == RotationAxis::ANY)
    return similarity;
  const Eigen::Matrix3d linear = similarity.topLeftCorner<3, 3>();
  const double scale = scaleOf(similarity);
  StoredPose turned = similarity;
  turned.topLeftCorner<3, 3>() = scale * nearestRotation(linear / scale, axis);
  turned.topRightCorner<3, 1>() += (linear - turned.topLeftCorner<3, 3>()) * point;
  return turned;
}

} // namespace kss
} // namespace pcl
