/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "refinement/plane_pulls.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include <algorithm>

namespace pcl {
namespace kss {
namespace {

/** Turns that the linear equations are good for, in radians. */
constexpr double largest_turn = 0.5;

} // namespace

Similarity
PlanePulls::moved(const Similarity& pose) const
{
  // what pulls towards points: sums of F'F, F = [-[x]_x, I]
  Eigen::Matrix3f cross;
  cross << 0.0f, -places_.z(), places_.y(), places_.z(), 0.0f, -places_.x(),
      -places_.y(), places_.x(), 0.0f;
  Eigen::Matrix<float, 6, 6> along;
  along << products_.trace() * Eigen::Matrix3f::Identity() - products_, cross,
      cross.transpose(), weight_ * Eigen::Matrix3f::Identity();
  const Eigen::Matrix<double, 6, 6> matrix = (matrix_ + epsilon * along).cast<double>();
  const Eigen::Matrix<double, 6, 1> motion =
      -matrix.ldlt().solve(gradient_.cast<double>());
  if (!motion.allFinite())
    return pose;
  Similarity moved = pose;
  const double angle = motion.head<3>().norm();
  if (angle > 0.0) {
    const Eigen::Matrix3d turn =
        Eigen::AngleAxisd(std::min(angle, largest_turn), motion.head<3>() / angle)
            .toRotationMatrix();
    moved.rotation = turn * moved.rotation;
    moved.translation = turn * moved.translation;
  }
  moved.translation += motion.tail<3>();
  return moved;
}

} // namespace kss
} // namespace pcl
