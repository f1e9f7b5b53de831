/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/detail/points.h>

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

} // namespace kss
} // namespace pcl
