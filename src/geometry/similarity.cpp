/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include <pcl/registration/kss/detail/similarity.h>

#include <Eigen/LU>

#include <cmath>

namespace pcl {
namespace kss {

bool
isSimilarity(const Eigen::Matrix4d& matrix)
{
  const Eigen::RowVector4d last_row(0.0, 0.0, 0.0, 1.0);
  // between clouds of any two sizes that are taken
  constexpr double most_scale = 1e25, farthest = 1e30;
  const double scale = scaleOf(matrix);
  if (!matrix.allFinite() || !matrix.row(3).isApprox(last_row) ||
      !(scale > 1.0 / most_scale && scale < most_scale) ||
      matrix.topRightCorner<3, 1>().cwiseAbs().maxCoeff() > farthest)
    return false;
  const Eigen::Matrix3d rotation = matrix.topLeftCorner<3, 3>() / scale;
  return (rotation * rotation.transpose()).isIdentity(1e-3);
}

double
scaleOf(const Eigen::Matrix4d& similarity)
{
  return std::cbrt(similarity.topLeftCorner<3, 3>().determinant());
}

} // namespace kss
} // namespace pcl
