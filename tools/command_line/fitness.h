/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/detail/cloud_conversion.h>
#include <pcl/search/kdtree.h>

#include <vector>

namespace tool {

/** \brief So many points of a source tell its fitness: a hundredth of the squared
 * distances' deviation is the error of their mean. */
constexpr std::size_t FITNESS_POINTS = 10000;

/** \brief The mean squared distance of a source's points from the nearest points of its
 * target, by FITNESS_POINTS of them, spread over the cloud as it is stored.
 * \param[in] placed the source where it has been registered; at least one point, all
 * finite
 * \param[in] tree of the target
 */
template <typename PointT>
double
fitnessOf(const pcl::PointCloud<PointT>& placed,
          const pcl::search::KdTree<PointT>& tree)
{
  pcl::Indices some = pcl::kss::spread(pcl::kss::allIndices(placed), FITNESS_POINTS);
  pcl::kss::sortInSpace(pcl::kss::placesOf(placed), some);
  double sum = 0.0;
  pcl::Indices nearest(1);
  std::vector<float> squared(1);
  for (const pcl::index_t i : some) {
    tree.nearestKSearch(placed[i], 1, nearest, squared);
    sum += squared[0];
  }
  return sum / static_cast<double>(some.size());
}

} // namespace tool
