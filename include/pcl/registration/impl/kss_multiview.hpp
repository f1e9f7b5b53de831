/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss_multiview.h>

#include <pcl/common/transforms.h>
#include <pcl/type_traits.h>

#include <utility>

namespace pcl {
namespace registration {

template <typename PointT>
std::size_t
KSSMultiview<PointT>::addScan(const PointCloudConstPtr& cloud)
{
  scans_.push_back(cloud);
  return scans_.size() - 1;
}

template <typename PointT>
void
KSSMultiview<PointT>::clear()
{
  scans_.clear();
  result_ = {};
}

template <typename PointT>
bool
KSSMultiview<PointT>::align()
{
  const auto load = [this](std::size_t number) {
    kss::Cloud cloud;
    if (!scans_[number])
      return cloud;
    const PointCloud& points = *scans_[number];
    cloud.points.resize(3, points.size());
    for (std::size_t i = 0; i < points.size(); ++i)
      cloud.points.col(i) = points[i].getVector3fMap().template cast<double>();
    if constexpr (pcl::traits::has_normal<PointT>::value) {
      cloud.normals.resize(3, points.size());
      for (std::size_t i = 0; i < points.size(); ++i)
        cloud.normals.col(i) = points[i].getNormalVector3fMap();
    }
    return cloud;
  };
  kss::Settings settings = settings_;
  settings.estimate_scale = false;
  kss::ScanWorker worker(settings, load, room_);
  kss::ThreadCrew crew(worker, settings.threads);
  result_ = kss::connectScans(scans_.size(), multiview_settings_, crew, progress_);
  return result_.failure.cause == kss::FailureCause::NONE;
}

template <typename PointT>
void
KSSMultiview<PointT>::getMergedCloud(std::size_t group, PointCloud& cloud) const
{
  PointCloud merged;
  for (const std::size_t scan : result_.groups.at(group)) {
    PointCloud placed;
    const Eigen::Matrix4f pose = getPose(scan).cast<float>();
    if constexpr (pcl::traits::has_normal<PointT>::value)
      pcl::transformPointCloudWithNormals(*scans_[scan], placed, pose);
    else
      pcl::transformPointCloud(*scans_[scan], placed, pose);
    merged += placed;
  }
  cloud = std::move(merged);
}

} // namespace registration
} // namespace pcl
