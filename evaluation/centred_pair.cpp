/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "centred_pair.h"

#include "neighbour_distances.h"

#include <pcl/common/centroid.h>

#include <algorithm>
#include <cmath>

namespace evaluation {
namespace {

Eigen::Vector3d
centre(const Cloud& cloud, Cloud& centred)
{
  Eigen::Vector4d centroid = Eigen::Vector4d::Zero();
  pcl::compute3DCentroid(cloud, centroid);
  centred = cloud;
  for (auto& point : centred) {
    const Eigen::Vector3d position = point.getVector3fMap().cast<double>();
    point.getVector3fMap() = (position - centroid.head<3>()).cast<float>();
  }
  return centroid.head<3>();
}

} // namespace

CentredPair::CentredPair(const Task& task)
: source_centroid(centre(*task.source, *source))
, target_centroid(centre(*task.target, *target))
{
}

Eigen::Matrix4d
CentredPair::uncentred(const Eigen::Matrix4d& pose) const
{
  Eigen::Matrix4d result = pose;
  result.topRightCorner<3, 1>() +=
      target_centroid - pose.topLeftCorner<3, 3>() * source_centroid;
  return result;
}

float
rmsRadiusOf(const Cloud& cloud)
{
  double sum = 0.0;
  for (const auto& point : cloud)
    sum += point.getVector3fMap().squaredNorm();
  return static_cast<float>(std::sqrt(sum / static_cast<double>(cloud.size())));
}

float
spacingOf(const Cloud::ConstPtr& cloud)
{
  const std::size_t step = std::max<std::size_t>(1, cloud->size() / 1000);
  return static_cast<float>(meanNeighbourDistance(cloud, 1, step));
}

} // namespace evaluation
