/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "geometry/similarity.h"

#include <pcl/registration/kss/detail/similarity.h>

#include <Eigen/LU>

#include <cmath>

namespace pcl {
namespace kss {

Similarity
Similarity::of(const Eigen::Matrix4d& matrix)
{
  const double scale = scaleOf(matrix);
  return {scale, matrix.topLeftCorner<3, 3>() / scale, matrix.topRightCorner<3, 1>()};
}

Eigen::Matrix3d
Similarity::linear() const
{
  return scale * rotation;
}

Similarity
Similarity::inverse() const
{
  return {1.0 / scale, rotation.transpose(),
          -(rotation.transpose() * translation) / scale};
}

Placement
Similarity::placement() const
{
  Placement rows;
  rows << linear().cast<float>(), translation.cast<float>();
  return rows;
}

Eigen::Affine3f
Similarity::affine() const
{
  return affineOf(placement());
}

Similarity
operator*(const Similarity& a, const Similarity& b)
{
  return {a.scale * b.scale, a.rotation * b.rotation,
          a.scale * (a.rotation * b.translation) + a.translation};
}

Eigen::Matrix4d
Similarity::matrix() const
{
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
  matrix.topLeftCorner<3, 3>() = linear();
  matrix.topRightCorner<3, 1>() = translation;
  return matrix;
}

bool
Similarity::isUsable() const
{
  // between clouds of any two sizes that are taken
  constexpr double most_scale = 1e25, farthest = 1e30;
  return scale > 1.0 / most_scale && scale < most_scale && rotation.allFinite() &&
         translation.allFinite() && translation.cwiseAbs().maxCoeff() <= farthest &&
         (rotation * rotation.transpose()).isIdentity(1e-3);
}

bool
isSimilarity(const Eigen::Matrix4d& matrix)
{
  const Eigen::RowVector4d last_row(0.0, 0.0, 0.0, 1.0);
  return matrix.allFinite() && matrix.row(3).isApprox(last_row) &&
         Similarity::of(matrix).isUsable();
}

double
scaleOf(const Eigen::Matrix4d& similarity)
{
  return std::cbrt(similarity.topLeftCorner<3, 3>().determinant());
}

} // namespace kss
} // namespace pcl
