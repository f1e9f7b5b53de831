/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/detail/points.h>

#include <algorithm>
#include <cmath>

namespace pcl {
namespace kss {

/** \brief Whether two clouds have the same points, in the same order. */
inline bool
areEqual(const Points& a, const Points& b)
{
  return a.cols() == b.cols() && a == b;
}

/** \brief The longest edge of a cloud's bounding box, L_p of (e6). */
inline float
longestEdge(const Points& cloud)
{
  return (cloud.rowwise().maxCoeff() - cloud.rowwise().minCoeff()).maxCoeff();
}

/** \brief The root mean square distance of the points from a centre. */
inline float
rootMeanSquareRadius(const Points& cloud, const Eigen::Vector3f& center)
{
  return std::sqrt((cloud.colwise() - center).squaredNorm() / cloud.cols());
}

/** \brief How much wider than usual the cells around a cloud may be: some fifty along
 * the cloud are too many for fewer than 216 points, 512 cells a point.
 */
inline float
coarseness(const Points& cloud)
{
  return std::max(1.0f, 6.0f / std::cbrt(static_cast<float>(cloud.cols())));
}

} // namespace kss
} // namespace pcl
