/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include <pcl/registration/kss_icp.h>

#include <cmath>
#include <iostream>

/** Registers a helix that widens with a turned, scaled copy of it. */
int
main()
{
  pcl::PointCloud<pcl::PointXYZ>::Ptr source(new pcl::PointCloud<pcl::PointXYZ>);
  pcl::PointCloud<pcl::PointXYZ>::Ptr target(new pcl::PointCloud<pcl::PointXYZ>);
  for (int i = 0; i < 600; ++i) {
    const float t = 0.02f * i;
    const pcl::PointXYZ point(t * std::cos(t), t * std::sin(t), 0.5f * t * t);
    source->push_back(point);
    target->push_back({3.0f - 2.0f * point.y, 2.0f * point.x, 2.0f * point.z});
  }
  pcl::KSSICP<pcl::PointXYZ, pcl::PointXYZ> registration;
  registration.setNumberOfSamplePoints(150);
  registration.setInputSource(source);
  registration.setInputTarget(target);
  pcl::PointCloud<pcl::PointXYZ> aligned;
  registration.align(aligned);
  std::cout << registration.getFinalTransformation() << '\n'
            << registration.getFailureReason() << '\n';
  return registration.hasConverged() && std::abs(registration.getScale() - 2.0) < 0.05
             ? 0
             : 1;
}
