/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss_multiview.h>

#include <pcl/common/transforms.h>
#include <pcl/console/print.h>
#include <pcl/type_traits.h>

#include <memory>
#include <string>
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
void
KSSMultiview<PointT>::setSettings(const kss::Settings& settings)
{
  const kss::CheckedSettings checked = kss::checked(settings, settings_);
  for (const std::string& refusal : checked.refusals)
    PCL_ERROR("[pcl::registration::KSSMultiview] %s\n", refusal.c_str());
  settings_ = checked.settings;
}

template <typename PointT>
bool
KSSMultiview<PointT>::align()
{
  const auto load = [this](std::size_t number) {
    const auto cloud = std::make_shared<kss::Cloud>();
    if (!scans_[number])
      return cloud;
    const PointCloud& points = *scans_[number];
    cloud->points.resize(3, points.size());
    for (std::size_t i = 0; i < points.size(); ++i)
      cloud->points.col(i) = points[i].getVector3fMap().template cast<double>();
    if constexpr (pcl::traits::has_normal<PointT>::value) {
      cloud->normals.resize(3, points.size());
      for (std::size_t i = 0; i < points.size(); ++i)
        cloud->normals.col(i) = points[i].getNormalVector3fMap();
    }
    return cloud;
  };
  kss::Settings settings = settings_;
  settings.estimate_scale = false;
  kss::ScanWorker worker(settings, load, room_);
  kss::ThreadCrew crew(worker, settings.threads);
  kss::MultiviewSettings multiview_settings = multiview_settings_;
  multiview_settings.threads = settings.threads;
  result_ = kss::connectScans(scans_.size(), multiview_settings, crew, progress_);
  return result_.failure.cause == kss::FailureCause::NONE;
}

template <typename PointT>
void
KSSMultiview<PointT>::getMergedCloud(std::size_t group, PointCloud& cloud) const
{
  PointCloud merged;
  for (const std::size_t scan : result_.groups.at(group)) {
    if (!scans_[scan] || scans_[scan]->empty()) // a group of its own
      continue;
    PointCloud placed;
    const Eigen::Matrix4f pose = getPose(scan).template cast<float>();
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
