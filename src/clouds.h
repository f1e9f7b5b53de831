/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/points.h>

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

} // namespace kss
} // namespace pcl
