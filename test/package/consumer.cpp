/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include <pcl/registration/kss_icp.h>

#include <cmath>
#include <iostream>

static_assert(alignof(pcl::kss::Alternative) <= alignof(double) &&
                  alignof(pcl::kss::Alignment) <= alignof(double),
              "what passes between the library and a program, whatever its vectors");

/** Registers a helix that widens with a turned, scaled copy of it, twice: what is kept
 * from the first time is freed in the end. */
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
  pcl::KSSICP<pcl::PointXYZ, pcl::PointXYZ, double> registration;
  pcl::kss::Settings settings;
  settings.sample_points = 150;
  registration.setSettings(settings);
  registration.setInputSource(source);
  registration.setInputTarget(target);
  pcl::PointCloud<pcl::PointXYZ> aligned;
  registration.align(aligned);
  registration.align(aligned);
  std::cout << registration.getFinalTransformation() << '\n'
            << registration.getFailureReason() << '\n';
  // what the library has filled in is where the program looks for it
  const auto& alternatives = registration.getAlternatives();
  for (const auto& alternative : alternatives)
    if (!(alternative.overlap.score >= 0.0 && alternative.overlap.score <= 2.0))
      return 1;
  if (alternatives.empty() ||
      alternatives.front().transformation != registration.getFinalTransformation())
    return 1;
  return registration.hasConverged() && std::abs(registration.getScale() - 2.0) < 0.05
             ? 0
             : 1;
}
