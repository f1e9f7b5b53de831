/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "neighbour_distances.h"

#include <pcl/common/centroid.h>
#include <pcl/features/normal_3d.h>
#include <pcl/kdtree/kdtree_flann.h>

#include <cmath>

namespace evaluation {
namespace {

constexpr int papers_k = 12;

Cloud::Ptr
positionsOf(const SurfacePoints& points)
{
  const auto cloud = pcl::make_shared<Cloud>();
  for (const auto& point : points) {
    const Eigen::Vector3f p = point.position.cast<float>();
    cloud->push_back({p.x(), p.y(), p.z()});
  }
  return cloud;
}

} // namespace

double
meanNeighbourDistance(const Cloud::ConstPtr& cloud, int k, std::size_t step)
{
  pcl::KdTreeFLANN<pcl::PointXYZ> tree;
  tree.setInputCloud(cloud);
  double sum = 0.0;
  std::size_t distances = 0;
  pcl::Indices neighbours;
  std::vector<float> squared;
  for (std::size_t i = 0; i < cloud->size(); i += step) {
    tree.nearestKSearch((*cloud)[i], k + 1, neighbours, squared); // itself is first
    for (std::size_t n = 1; n < squared.size(); ++n, ++distances)
      sum += std::sqrt(squared[n]);
  }
  return sum / static_cast<double>(distances);
}

double
meanNeighbourDistance(const SurfacePoints& points)
{
  return meanNeighbourDistance(positionsOf(points), papers_k, 1);
}

void
estimateNormals(SurfacePoints& points)
{
  pcl::NormalEstimation<pcl::PointXYZ, pcl::Normal> estimation;
  estimation.setInputCloud(positionsOf(points));
  estimation.setKSearch(papers_k);
  pcl::PointCloud<pcl::Normal> normals;
  estimation.compute(normals);

  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const auto& point : points)
    middle += point.position / static_cast<double>(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    Eigen::Vector3d normal = normals[i].getNormalVector3fMap().cast<double>();
    if (!normal.allFinite())
      normal.setZero(); // fewer than three points around: no direction to move it
    points[i].normal = normal.dot(points[i].position - middle) < 0.0
                           ? Eigen::Vector3d(-normal)
                           : normal;
  }
}

} // namespace evaluation
