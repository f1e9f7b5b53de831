/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/detail/points.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl {
namespace kss {

/** \brief Whether two clouds have the same points, in the same order. */
inline bool
areEqual(const Points& a, const Points& b)
{
  return a.cols() == b.cols() && a == b;
}

/** \brief The box around a cloud; empty where there is no point. */
inline Eigen::AlignedBox3f
boxOf(const Points& cloud)
{
  // four points at once are whole vectors
  constexpr int many = 12;
  constexpr float infinite = std::numeric_limits<float>::infinity();
  using Block = Eigen::Array<float, many, 1>;
  Block lower = Block::Constant(infinite), upper = -lower;
  const Eigen::Index blocks = cloud.size() / many;
  for (Eigen::Index b = 0; b < blocks; ++b) {
    const Block block = Eigen::Map<const Block>(cloud.data() + b * many);
    lower = lower.min(block);
    upper = upper.max(block);
  }
  Eigen::AlignedBox3f box;
  for (Eigen::Index i = blocks * many / 3; i < cloud.cols(); ++i)
    box.extend(cloud.col(i));
  if (blocks > 0)
    for (int i = 0; i < many; i += 3)
      box.extend(Eigen::AlignedBox3f(lower.segment<3>(i), upper.segment<3>(i)));
  return box;
}

/** \brief The longest edge of a cloud's bounding box, L_p of (e6). */
inline float
longestEdge(const Points& cloud)
{
  return boxOf(cloud).sizes().maxCoeff();
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
