/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/point_cloud.h>
#include <pcl/registration/kss/points.h>
#include <pcl/types.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace pcl {
namespace kss {

/** \brief Those of the indices whose points have finite coordinates. */
template <typename PointT>
Indices
finiteIndices(const PointCloud<PointT>& cloud, const Indices& indices)
{
  Indices finite;
  finite.reserve(indices.size());
  for (const index_t i : indices)
    if (cloud[i].getVector3fMap().allFinite())
      finite.push_back(i);
  return finite;
}

/** \brief The indices of all points whose coordinates are finite. */
template <typename PointT>
Indices
finiteIndices(const PointCloud<PointT>& cloud)
{
  Indices all(cloud.size());
  std::iota(all.begin(), all.end(), 0);
  return finiteIndices(cloud, all);
}

/** \brief The coordinates of some points of a cloud, in a frame near their middle. */
template <typename PointT>
LocalCloud
toLocalCloud(const PointCloud<PointT>& cloud, const Indices& indices)
{
  LocalCloud local;
  for (const index_t i : indices)
    local.origin += cloud[i].getVector3fMap().template cast<double>();
  local.origin /= static_cast<double>(std::max<std::size_t>(1, indices.size()));
  local.points.resize(3, indices.size());
  for (std::size_t i = 0; i < indices.size(); ++i)
    local.points.col(i) =
        (cloud[indices[i]].getVector3fMap().template cast<double>() - local.origin)
            .template cast<float>();
  return local;
}

/** \brief What rounding alone contributes to the squared distance of two points: a few
 * dozen roundings of the largest coordinate, as many steps of ICP make.
 */
template <typename PointT>
double
roundingError(const PointCloud<PointT>& cloud)
{
  double largest = 0.0;
  for (const PointT& point : cloud)
    if (point.getVector3fMap().allFinite())
      largest = std::max<double>(largest, point.getVector3fMap().squaredNorm());
  return largest * std::pow(10.0 * std::numeric_limits<float>::epsilon(), 2);
}

} // namespace kss
} // namespace pcl
