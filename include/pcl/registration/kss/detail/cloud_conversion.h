/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <pcl/registration/kss/detail/usable_points.h>
#include <pcl/types.h>

#include <algorithm>
#include <numeric>

namespace pcl {
namespace kss {

/** \brief The positions of a cloud's points.
 * \param[in] cloud kept by reference
 */
template <typename PointT>
auto
placesOf(const PointCloud<PointT>& cloud)
{
  return [&cloud](index_t i) { return cloud[i].getVector3fMap(); };
}

/** \brief The indices of all points. */
template <typename PointT>
Indices
allIndices(const PointCloud<PointT>& cloud)
{
  Indices all(cloud.size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

/** \brief Whether all differences and sums of finite coordinates are floats. PCL's tree
 * ends the process where they are not.
 */
template <typename PointT>
bool
canBeSearched(const PointCloud<PointT>& cloud)
{
  constexpr float farthest = 1e38f;
  return std::none_of(cloud.begin(), cloud.end(), [](const PointT& point) {
    const Eigen::Vector3f place = point.getVector3fMap();
    return place.allFinite() && place.cwiseAbs().maxCoeff() > farthest;
  });
}

/** \brief Some points of a cloud, as a cloud.
 * \param[in] indices may name points more than once
 */
template <typename PointT>
typename PointCloud<PointT>::ConstPtr
pointsAt(const PointCloud<PointT>& cloud, const Indices& indices)
{
  const auto points = pcl::make_shared<PointCloud<PointT>>();
  points->header = cloud.header;
  points->reserve(indices.size());
  for (const index_t i : indices)
    points->push_back(cloud[i]);
  return points;
}

/** \brief What of a cloud in single precision a registration goes by: usablePoints().
 * \throws std::invalid_argument as that does, or where throwIfTooFar() does
 */
template <typename PointT>
UsablePoints<index_t>
usablePointsOf(const PointCloud<PointT>& cloud, const Indices& indices)
{
  UsablePoints<index_t> usable = usablePoints(placesOf(cloud), indices);
  throwIfTooFar(usable.bulk);
  return usable;
}

/** \brief The usable points of a cloud, with their normals if it has some, in a frame
 * in their middle. */
template <typename PointT>
LocalCloud
toLocalCloud(const PointCloud<PointT>& cloud, const UsablePoints<index_t>& usable)
{
  LocalCloud local = localCloud(placesOf(cloud), usable);
  if constexpr (traits::has_normal<PointT>::value)
    local.normals =
        unitNormals([&cloud](index_t i) { return cloud[i].getNormalVector3fMap(); },
                    usable.indices);
  return local;
}

} // namespace kss
} // namespace pcl
