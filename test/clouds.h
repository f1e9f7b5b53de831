/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "poses.h"

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <limits>

namespace kss_test {

template <typename PointT>
typename pcl::PointCloud<PointT>::Ptr
cloudOf(const Points& points)
{
  auto cloud = pcl::make_shared<pcl::PointCloud<PointT>>();
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    PointT point;
    point.getVector3fMap() = points.col(i);
    cloud->push_back(point);
  }
  return cloud;
}

template <typename PointT>
Points
pointsOf(const pcl::PointCloud<PointT>& cloud)
{
  Points points(3, cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i)
    points.col(i) = cloud[i].getVector3fMap();
  return points;
}

template <typename PointT>
void
makeNaN(PointT& point)
{
  point.getVector3fMap().setConstant(std::numeric_limits<float>::quiet_NaN());
}

} // namespace kss_test
