/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/detail/points.h>

#include <algorithm>
#include <vector>

namespace pcl {
namespace kss {

/** \brief Those points of a cloud, in that order. */
inline Points
take(const Points& cloud, const std::vector<int>& indices)
{
  Points taken(3, indices.size());
  for (std::size_t i = 0; i < indices.size(); ++i)
    taken.col(i) = cloud.col(indices[i]);
  return taken;
}

/** \brief The index of one of so many that are spread evenly over all. */
inline Eigen::Index
evenlySpaced(Eigen::Index i, Eigen::Index most, Eigen::Index all)
{
  return i * all / most;
}

/** \brief So many points of a cloud, at most, that are spread evenly over their order.
 */
inline Points
evenlySpaced(const Points& cloud, Eigen::Index most)
{
  const Eigen::Index size = std::min(most, cloud.cols());
  Points taken(3, size);
  for (Eigen::Index i = 0; i < size; ++i)
    taken.col(i) = cloud.col(evenlySpaced(i, size, cloud.cols()));
  return taken;
}

} // namespace kss
} // namespace pcl
