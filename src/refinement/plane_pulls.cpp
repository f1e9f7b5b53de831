/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "refinement/plane_pulls.h"

#include "support/wide_vectors.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include <algorithm>

namespace pcl {
namespace kss {
namespace {

/** Turns that the linear equations are good for, in radians. */
constexpr double largest_turn = 0.5;

/** Coordinates apart. */
struct Columns {
  const float *x, *y, *z;
};

/** Add up what correspondences pull by along normals.
 * \param[in,out] sums see PlanePulls
 */
PCL_KSS_WIDE void
addAlong(const Columns& placed,
         const Columns& target,
         const Columns& normals,
         const float* weights,
         Eigen::Index n,
         double (&sums)[PlanePulls::along_sums])
{
  float a[PlanePulls::along_sums][lanes] = {};
  for (Eigen::Index i = 0; i < n; i += lanes)
    for (int l = 0; l < lanes; ++l) {
      const float w = weights[i + l];
      const float px = placed.x[i + l], py = placed.y[i + l], pz = placed.z[i + l];
      const float nx = normals.x[i + l], ny = normals.y[i + l], nz = normals.z[i + l];
      // the row of the equations: turn and normal
      const float rx = py * nz - pz * ny, ry = pz * nx - px * nz,
                  rz = px * ny - py * nx;
      const float wrx = w * rx, wry = w * ry, wrz = w * rz;
      const float wnx = w * nx, wny = w * ny, wnz = w * nz;
      const float off = nx * (px - target.x[i + l]) + ny * (py - target.y[i + l]) +
                        nz * (pz - target.z[i + l]);
      a[0][l] += wrx * rx;
      a[1][l] += wry * rx;
      a[2][l] += wry * ry;
      a[3][l] += wrz * rx;
      a[4][l] += wrz * ry;
      a[5][l] += wrz * rz;
      a[6][l] += wnx * rx;
      a[7][l] += wnx * ry;
      a[8][l] += wnx * rz;
      a[9][l] += wnx * nx;
      a[10][l] += wny * rx;
      a[11][l] += wny * ry;
      a[12][l] += wny * rz;
      a[13][l] += wny * nx;
      a[14][l] += wny * ny;
      a[15][l] += wnz * rx;
      a[16][l] += wnz * ry;
      a[17][l] += wnz * rz;
      a[18][l] += wnz * nx;
      a[19][l] += wnz * ny;
      a[20][l] += wnz * nz;
      a[21][l] += wrx * off;
      a[22][l] += wry * off;
      a[23][l] += wrz * off;
      a[24][l] += wnx * off;
      a[25][l] += wny * off;
      a[26][l] += wnz * off;
    }
  for (int s = 0; s < PlanePulls::along_sums; ++s)
    for (int l = 0; l < lanes; ++l)
      sums[s] += a[s][l];
}

/** And towards points. */
PCL_KSS_WIDE void
addTowards(const Columns& placed,
           const Columns& target,
           const float* weights,
           Eigen::Index n,
           double (&sums)[PlanePulls::towards_sums])
{
  float t[PlanePulls::towards_sums][lanes] = {};
  for (Eigen::Index i = 0; i < n; i += lanes)
    for (int l = 0; l < lanes; ++l) {
      const float w = weights[i + l];
      const float px = placed.x[i + l], py = placed.y[i + l], pz = placed.z[i + l];
      const float dx = px - target.x[i + l], dy = py - target.y[i + l],
                  dz = pz - target.z[i + l];
      const float wx = w * px, wy = w * py, wz = w * pz;
      t[0][l] += w;
      t[1][l] += wx;
      t[2][l] += wy;
      t[3][l] += wz;
      t[4][l] += wx * px;
      t[5][l] += wx * py;
      t[6][l] += wx * pz;
      t[7][l] += wy * py;
      t[8][l] += wy * pz;
      t[9][l] += wz * pz;
      t[10][l] += wy * dz - wz * dy;
      t[11][l] += wz * dx - wx * dz;
      t[12][l] += wx * dy - wy * dx;
      t[13][l] += w * dx;
      t[14][l] += w * dy;
      t[15][l] += w * dz;
    }
  for (int s = 0; s < PlanePulls::towards_sums; ++s)
    for (int l = 0; l < lanes; ++l)
      sums[s] += t[s][l];
}

Columns
columnsOf(const PlanePulls::Rows& rows)
{
  return {rows.row(0).data(), rows.row(1).data(), rows.row(2).data()};
}

} // namespace

void
PlanePulls::add(const Rows& placed,
                const Rows& target,
                const Rows& normals,
                const Eigen::RowVectorXf& weights)
{
  const Columns from = columnsOf(placed), to = columnsOf(target);
  addAlong(from, to, columnsOf(normals), weights.data(), weights.size(), along_);
  addTowards(from, to, weights.data(), weights.size(), towards_);
}

Similarity
PlanePulls::moved(const Similarity& pose, const Turns& turns) const
{
  using Matrix6 = Eigen::Matrix<double, 6, 6>;
  using Vector6 = Eigen::Matrix<double, 6, 1>;
  Matrix6 along;
  for (int i = 0, s = 0; i < unknowns; ++i)
    for (int j = 0; j <= i; ++j, ++s)
      along(i, j) = along(j, i) = along_[s];
  // what pulls towards points: sums of F'F, F = [-[x]_x, I]
  const double* const t = towards_;
  Eigen::Matrix3d products, cross;
  products << t[4], t[5], t[6], t[5], t[7], t[8], t[6], t[8], t[9];
  cross << 0.0, -t[3], t[2], t[3], 0.0, -t[1], -t[2], t[1], 0.0;
  Matrix6 towards;
  towards << products.trace() * Eigen::Matrix3d::Identity() - products, cross,
      cross.transpose(), t[0] * Eigen::Matrix3d::Identity();
  const Matrix6 matrix = (1.0 - epsilon) * along + epsilon * towards;
  const Vector6 gradient =
      (1.0 - epsilon) * Eigen::Map<const Vector6>(along_ + gradient_along) +
      epsilon * Eigen::Map<const Vector6>(towards_ + gradient_towards);
  Eigen::MatrixXd free = Eigen::MatrixXd::Zero(unknowns, turns.cols() + 3);
  free.topLeftCorner(3, turns.cols()) = turns;
  free.bottomRightCorner<3, 3>().setIdentity();
  const Eigen::VectorXd solution =
      (free.transpose() * matrix * free).ldlt().solve(free.transpose() * gradient);
  const Vector6 motion = -(free * solution);
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
