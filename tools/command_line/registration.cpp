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

/** The finite points as floats, which PCL's point types hold, in a local frame; zeros
 * for normals that are not known. */
template <typename PointT>
typename pcl::PointCloud<PointT>::Ptr
localCloud(const SurfacePoints& points, const Eigen::Vector3d& origin)
{
  auto cloud = pcl::make_shared<pcl::PointCloud<PointT>>();
  for (std::size_t i = 0; i < points.positions.size(); ++i) {
    PointT point;
    point.getVector3fMap() = (points.positions[i] - origin).template cast<float>();
    if (!point.getVector3fMap().allFinite())
      continue;
    if constexpr (pcl::traits::has_normal<PointT>::value)
      if (!points.normals.empty())
        point.getNormalVector3fMap() = points.normals[i].template cast<float>();
    cloud->push_back(point);
  }
  return cloud;
}

std::size_t
finite(const Points& points)
{
  return std::count_if(points.begin(), points.end(),
                       [](const Eigen::Vector3d& point) { return point.allFinite(); });
}

/** registerClouds() with points of a type. */
template <typename PointT>
Result
registerAs(const SurfacePoints& source,
           const SurfacePoints& target,
           const pcl::kss::Settings& settings,
           const std::optional<Eigen::Matrix4d>& guess,
           int iterations)
{
  const auto start = std::chrono::steady_clock::now();
  const Eigen::Vector3d source_origin =
      pcl::kss::naming("source", [&] { return localOrigin(source.positions); });
  const Eigen::Vector3d target_origin =
      pcl::kss::naming("target", [&] { return localOrigin(target.positions); });

  pcl::KSSICP<PointT, PointT, double> registration;
  registration.setSettings(settings);
  if (iterations > 0)
    registration.setMaximumIterations(iterations);
  const auto source_cloud = localCloud<PointT>(source, source_origin);
  const auto target_cloud = localCloud<PointT>(target, target_origin);
  registration.setInputSource(source_cloud);
  registration.setInputTarget(target_cloud);
  pcl::PointCloud<PointT> aligned;
  if (guess)
    registration.align(aligned, toLocalFrames(*guess, source_origin, target_origin));
  else
    registration.align(aligned);

  Result result;
  result.converged = registration.hasConverged();
  result.cause = registration.getFailureCause();
  result.reason = registration.getFailureReason();
  for (const auto& pose : registration.getAlternatives())
    result.poses.push_back(
        {fromLocalFrames(pose.transformation, source_origin, target_origin),
         pose.overlap, pose.evidence});
  result.scale = registration.getScale();
  result.covariance = registration.getCovariance();
  result.scale_deviation = registration.getScaleDeviation();
  result.undetermined = registration.getUndeterminedDirections();
  result.confidence = registration.getConfidence();
  result.ambiguous = registration.isAmbiguous();
  result.mode = registration.getFoundMode();
  result.search = pcl::kss::searchOf(settings);
  result.fitness = registration.getFitnessScore();
  // those that floats cannot hold are farther away still
  const auto far = registration.getNumberOfFarPoints();
  result.far_points = {far.source + finite(source.positions) - source_cloud->size(),
                       far.target + finite(target.positions) - target_cloud->size()};
  result.device = registration.getDeviceName();
  result.stages = registration.getStageSeconds();
  const std::chrono::duration<double> seconds =
      std::chrono::steady_clock::now() - start;
  result.seconds = seconds.count();
  return result;
}

} // namespace

Result
registerClouds(const SurfacePoints& source,
               const SurfacePoints& target,
               const pcl::kss::Settings& settings,
               const std::optional<Eigen::Matrix4d>& guess,
               int iterations)
{
  return source.normals.empty() && target.normals.empty()
             ? registerAs<pcl::PointXYZ>(source, target, settings, guess, iterations)
             : registerAs<pcl::PointNormal>(source, target, settings, guess,
                                            iterations);
}

} // namespace tool
