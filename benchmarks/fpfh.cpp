/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "fpfh.h"

#include <pcl/common/centroid.h>
#include <pcl/features/fpfh.h>
#include <pcl/features/normal_3d.h>
#include <pcl/filters/voxel_grid.h>

namespace benchmarks {

using Point = pcl::PointXYZ;

void
thin(const Cloud::ConstPtr& cloud, float leaf, Described& result)
{
  pcl::VoxelGrid<Point> grid;
  grid.setInputCloud(cloud);
  grid.setLeafSize(leaf, leaf, leaf);
  grid.filter(*result.points);
}

void
estimateNormals(float radius, Described& cloud)
{
  Eigen::Vector4f middle;
  pcl::compute3DCentroid(*cloud.points, middle);
  pcl::NormalEstimation<Point, pcl::Normal> estimation;
  estimation.setInputCloud(cloud.points);
  estimation.setViewPoint(middle.x(), middle.y(), middle.z());
  estimation.setRadiusSearch(radius);
  estimation.compute(*cloud.normals);
}

void
describe(float radius, Described& cloud)
{
  pcl::FPFHEstimation<Point, pcl::Normal, Feature> estimation;
  estimation.setInputCloud(cloud.points);
  estimation.setInputNormals(cloud.normals);
  estimation.setRadiusSearch(radius);
  estimation.compute(*cloud.features);
}

} // namespace benchmarks
