/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "geometry/pre_shape.h"

#include <Eigen/Eigenvalues>

#include <stdexcept>

namespace pcl {
namespace kss {

PreShape
toPreShape(const LocalCloud& cloud)
{
  const Eigen::Matrix3Xd points = cloud.points.cast<double>();
  const Eigen::Vector3d center = points.rowwise().mean();
  const Eigen::Matrix3Xd centred = points.colwise() - center;
  const double size = std::sqrt(centred.squaredNorm() / points.cols());
  if (!(size > 0.0))
    throw std::invalid_argument("all its points coincide");

  // The middle eigenvalue is the mean squared distance from the best line.
  const Eigen::Matrix3d scatter = centred * centred.transpose() / points.cols();
  const double off_line =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(scatter, Eigen::EigenvaluesOnly)
          .eigenvalues()[1];
  if (std::sqrt(std::max(0.0, off_line)) < 1e-5 * size)
    throw std::invalid_argument("its points lie on a line");

  return {(centred / size).cast<float>(), cloud.origin + center, size};
}

PreShape
withSize(const PreShape& shape, double size)
{
  return {shape.points * static_cast<float>(shape.size / size), shape.center, size};
}

} // namespace kss
} // namespace pcl
