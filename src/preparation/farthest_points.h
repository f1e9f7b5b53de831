/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/detail/points.h>

#include <cstddef>
#include <vector>

namespace pcl {
namespace kss {

/** \brief Points in an order such that any leading part of them covers the cloud
 * evenly.
 */
struct FarthestOrder {
  /** \brief Indices of points: each is the farthest from those before it. */
  std::vector<int> indices;
  /** \brief How far each is from the nearest of those before it; they never rise. The
   * first one's is infinite. */
  std::vector<float> gaps;
};

/** \brief Farthest point sampling of a cloud. The first point is the nearest to the
 * mean.
 *
 * Blocks of points that a new sample is too far away from are passed over, so that a
 * sample costs little more than the points around it.
 * \param[in] cloud at least one point
 * \param[in] most points to order at most
 */
FarthestOrder
inFarthestOrder(const Points& cloud, std::size_t most);

} // namespace kss
} // namespace pcl
