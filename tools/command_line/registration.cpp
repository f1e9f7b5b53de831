/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "registration.h"

#include "local_frame.h"

#include <pcl/registration/kss/detail/naming.h>
#include <pcl/registration/kss_icp.h>

#include <algorithm>
#include <chrono>

namespace tool {
namespace {

using Cloud = pcl::PointCloud<pcl::PointXYZ>;
using Registration = pcl::KSSICP<pcl::PointXYZ, pcl::PointXYZ, double>;

/** The finite points as floats, which PCL's point types hold, in a local frame. */
Cloud::Ptr
localCloud(const Points& points, const Eigen::Vector3d& origin)
{
  auto cloud = pcl::make_shared<Cloud>();
  for (const auto& point : points) {
    const Eigen::Vector3f local = (point - origin).cast<float>();
    if (local.allFinite())
      cloud->push_back({local.x(), local.y(), local.z()});
  }
  return cloud;
}

std::size_t
finite(const Points& points)
{
  return std::count_if(points.begin(), points.end(),
                       [](const Eigen::Vector3d& point) { return point.allFinite(); });
}

} // namespace

Result
registerClouds(const Points& source,
               const Points& target,
               const pcl::kss::Settings& settings,
               int iterations)
{
  const auto start = std::chrono::steady_clock::now();
  const Eigen::Vector3d source_origin =
      pcl::kss::naming("source", [&] { return localOrigin(source); });
  const Eigen::Vector3d target_origin =
      pcl::kss::naming("target", [&] { return localOrigin(target); });

  Registration registration;
  registration.setSettings(settings);
  if (iterations > 0)
    registration.setMaximumIterations(iterations);
  const Cloud::Ptr source_cloud = localCloud(source, source_origin);
  const Cloud::Ptr target_cloud = localCloud(target, target_origin);
  registration.setInputSource(source_cloud);
  registration.setInputTarget(target_cloud);
  Cloud aligned;
  registration.align(aligned);

  Result result;
  result.converged = registration.hasConverged();
  result.cause = registration.getFailureCause();
  result.reason = registration.getFailureReason();
  for (const auto& pose : registration.getAlternatives())
    result.poses.push_back(
        {fromLocalFrames(pose.transformation, source_origin, target_origin),
         pose.overlap});
  result.scale = registration.getScale();
  result.confidence = registration.getConfidence();
  result.ambiguous = registration.isAmbiguous();
  result.mode = registration.getFoundMode();
  result.search = pcl::kss::searchOf(settings);
  result.fitness = registration.getFitnessScore();
  // those that floats cannot hold are farther away still
  const auto far = registration.getNumberOfFarPoints();
  result.far_points = {far.source + finite(source) - source_cloud->size(),
                       far.target + finite(target) - target_cloud->size()};
  result.device = registration.getDeviceName();
  result.stages = registration.getStageSeconds();
  const std::chrono::duration<double> seconds =
      std::chrono::steady_clock::now() - start;
  result.seconds = seconds.count();
  return result;
}

} // namespace tool
