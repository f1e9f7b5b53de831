/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/detail/points.h>

#include "support/rounded_up.h"

namespace pcl {
namespace kss {

/** \brief A cloud's coordinates apart, filled up to whole vectors with copies of the
 * last point.
 * \param[in] cloud at least one point
 * \param[in] lanes of a vector
 */
inline Eigen::MatrixX3f
coordinateColumns(const Points& cloud, Eigen::Index lanes)
{
  const Eigen::Index points = cloud.cols(), filled = roundedUp(points, lanes);
  Eigen::MatrixX3f columns(filled, 3);
  columns.topRows(points) = cloud.transpose();
  columns.bottomRows(filled - points).rowwise() = cloud.col(points - 1).transpose();
  return columns;
}

} // namespace kss
} // namespace pcl
