/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "candidates/centers.h"

#include <pcl/registration/kss/detail/grid_index.h>

#include "candidates/numbers.h"

#include <Eigen/Eigenvalues>

#include <cmath>

namespace pcl {
namespace kss {
namespace {

using search_numbers::most_centers;

/** The grid {-n..n} x {-n..n} x {-n..n} along the columns of \a axes. */
CandidateCenters
grid(const Eigen::Matrix3d& axes,
     const Eigen::Array3d& spacing,
     const Eigen::Array3i& n)
{
  CandidateCenters found;
  found.axes = axes;
  found.spacing = spacing;
  for (int i = -n.x(); i <= n.x(); ++i)
    for (int j = -n.y(); j <= n.y(); ++j)
      for (int k = -n.z(); k <= n.z(); ++k)
        found.centers.push_back(axes * (spacing * Eigen::Array3d(i, j, k)).matrix());
  for (int axis = 0; axis < 3; ++axis)
    found.steps[axis] = 2 * n[axis] + 1;
  return found;
}

} // namespace

CandidateCenters
ownCenter()
{
  return grid(Eigen::Matrix3d::Identity(), Eigen::Array3d::Zero(),
              Eigen::Array3i::Zero());
}

CandidateCenters
paperCenters(const Points& cloud)
{
  // c_r is the origin
  const Eigen::Matrix3Xd points = cloud.cast<double>();
  Eigen::Index farthest;
  const double radius = std::sqrt(points.colwise().squaredNorm().maxCoeff(&farthest));
  Eigen::Matrix3d axes;
  axes.col(1) = points.col(farthest) / radius;
  // p_x: the nearest point that is not in line with p_y
  const Eigen::RowVectorXd off_line =
      (points - axes.col(1) * (axes.col(1).transpose() * points)).colwise().norm();
  const double line = std::min(1e-3 * radius, 0.5 * off_line.maxCoeff());
  Eigen::Index nearest = farthest;
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    if (off_line[i] > line &&
        (nearest == farthest ||
         points.col(i).squaredNorm() < points.col(nearest).squaredNorm()))
      nearest = i;
  axes.col(2) = points.col(nearest).cross(axes.col(1)).normalized();
  axes.col(0) = axes.col(1).cross(axes.col(2));
  const double search_radius = radius / 4.0; // r_s
  return grid(axes, Eigen::Array3d::Constant(search_radius / 2.0), {2, 2, 2});
}

CandidateCenters
spreadCenters(const Points& cloud, double reach, double step, double most)
{
  const Eigen::Matrix3Xd points = cloud.cast<double>();
  const Eigen::Matrix3d scatter = points * points.transpose() / points.cols();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(scatter);
  const Eigen::Array3d radius = reach * solver.eigenvalues().array().max(0.0).sqrt();
  Eigen::Array3d half;
  for (;; step *= 1.1) {
    // rounding aside, and a flat cloud is thin, not a box
    half = (radius < 0.05 * step).select(0, (radius / step - 1e-3).ceil().max(0.0));
    if ((2.0 * half + 1.0).prod() <= most)
      break;
  }
  const Eigen::Array3i n =
      toIndices(half, Eigen::Array3i::Constant(static_cast<int>(most_centers)));
  const Eigen::Array3d steps = radius / n.max(1).cast<double>();
  return grid(solver.eigenvectors(), steps, n);
}

} // namespace kss
} // namespace pcl
