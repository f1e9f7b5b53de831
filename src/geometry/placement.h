/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace pcl {
namespace kss {

/** \brief Places the source: the upper three rows of a similarity. */
using Placement = Eigen::Matrix<float, 3, 4, Eigen::RowMajor>;

/** \brief A placement for single points. */
inline Eigen::Affine3f
affineOf(const Placement& placement)
{
  Eigen::Affine3f map;
  map.affine() = placement;
  map.makeAffine();
  return map;
}

/** \brief By how much a placement scales. */
inline float
scaleFactorOf(const Placement& placement)
{
  return placement.row(0).head<3>().norm();
}

/** \brief The inverse of x -> s R x + t: x -> (s R)^T (x - t) / s^2. */
inline Placement
inverseOf(const Placement& placement)
{
  const float scale = scaleFactorOf(placement);
  Placement inverse;
  inverse.leftCols<3>() = placement.leftCols<3>().transpose() / (scale * scale);
  inverse.col(3) = -inverse.leftCols<3>() * placement.col(3);
  return inverse;
}

} // namespace kss
} // namespace pcl
