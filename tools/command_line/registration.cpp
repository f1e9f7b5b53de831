/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "registration.h"

#include "fitness.h"
#include "io/fields.h"
#include "io/vector_field.h"
#include "local_frame.h"

#include <pcl/registration/kss/detail/naming.h>
#include <pcl/registration/kss_icp.h>

#include <chrono>

namespace tool {
namespace {

/** The finite points as floats, which PCL's point types hold, in a local frame; zeros
 * for normals that are not known.
 * \param[out] unheld how many finite points floats cannot hold there
 */
template <typename PointT>
typename pcl::PointCloud<PointT>::Ptr
localCloud(const pcl::PCLPointCloud2& points,
           const Eigen::Vector3d& origin,
           std::size_t& unheld)
{
  const VectorField positions(points, VectorField::POSITION);
  const VectorField normals(points, VectorField::NORMAL);
  const bool has_normals = normals.exists();
  auto cloud = pcl::make_shared<pcl::PointCloud<PointT>>();
  cloud->reserve(numberOfPoints(points));
  unheld = 0;
  for (std::size_t i = 0; i < numberOfPoints(points); ++i) {
    const std::uint8_t* bytes = &points.data[i * points.point_step];
    const Eigen::Vector3d position = positions.get(bytes);
    PointT point;
    point.getVector3fMap() = (position - origin).template cast<float>();
    if (!point.getVector3fMap().allFinite()) {
      unheld += position.allFinite() ? 1 : 0;
      continue;
    }
    if constexpr (pcl::traits::has_normal<PointT>::value)
      if (has_normals)
        point.getNormalVector3fMap() = normals.get(bytes).template cast<float>();
    cloud->points.push_back(point);
  }
  cloud->width = static_cast<std::uint32_t>(cloud->size());
  cloud->height = 1;
  return cloud;
}

/** registerClouds() with points of a type. */
template <typename PointT>
Result
registerAs(const pcl::PCLPointCloud2& source,
           const pcl::PCLPointCloud2& target,
           const pcl::kss::Settings& settings,
           const std::optional<Eigen::Matrix4d>& guess,
           int iterations,
           bool with_fitness)
{
  const auto start = std::chrono::steady_clock::now();
  const Eigen::Vector3d source_origin =
      pcl::kss::naming("source", [&] { return localOrigin(source); });
  const Eigen::Vector3d target_origin =
      pcl::kss::naming("target", [&] { return localOrigin(target); });

  pcl::KSSICP<PointT, PointT, double> registration;
  registration.setSettings(settings);
  if (iterations > 0)
    registration.setMaximumIterations(iterations);
  pcl::kss::FarPoints unheld;
  registration.setInputSource(localCloud<PointT>(source, source_origin, unheld.source));
  registration.setInputTarget(localCloud<PointT>(target, target_origin, unheld.target));
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
  // on large clouds the nearest points of all take longer than the registration
  if (with_fitness && !result.poses.empty())
    result.fitness = fitnessOf(aligned, *registration.getSearchMethodTarget());
  // those that floats cannot hold are farther away still
  const auto far = registration.getNumberOfFarPoints();
  result.far_points = {far.source + unheld.source, far.target + unheld.target};
  result.device = registration.getDeviceName();
  result.stages = registration.getStageSeconds();
  const std::chrono::duration<double> seconds =
      std::chrono::steady_clock::now() - start;
  result.seconds = seconds.count();
  return result;
}

} // namespace

Result
registerClouds(const pcl::PCLPointCloud2& source,
               const pcl::PCLPointCloud2& target,
               const pcl::kss::Settings& settings,
               const std::optional<Eigen::Matrix4d>& guess,
               int iterations,
               bool with_fitness)
{
  const bool has_normals = VectorField(source, VectorField::NORMAL).exists() ||
                           VectorField(target, VectorField::NORMAL).exists();
  const auto register_as =
      has_normals ? registerAs<pcl::PointNormal> : registerAs<pcl::PointXYZ>;
  return register_as(source, target, settings, guess, iterations, with_fitness);
}

} // namespace tool
