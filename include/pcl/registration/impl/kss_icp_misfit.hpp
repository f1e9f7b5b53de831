/*
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * Where nothing fits: what would.
 */

#pragma once

#include <pcl/registration/kss/detail/misfit.h>
#include <pcl/registration/kss/detail/similarity.h>
#include <pcl/registration/kss_icp.h>

#include <cmath>

namespace pcl {

template <typename PointSource, typename PointTarget, typename Scalar>
std::string
KSSICP<PointSource, PointTarget, Scalar>::whatWouldFit(double given_scale)
{
  if (getOverlap().score >= kss::resembling) {
    const auto mirrored = pcl::make_shared<PointCloudSource>();
    copyIndexedSource(*mirrored);
    for (PointSource& point : *mirrored) {
      point.getVector3fMap() *= static_cast<float>(given_scale);
      point.getVector3fMap().x() *= -1.0f;
      if constexpr (traits::has_normal<PointSource>::value)
        point.getNormalVector3fMap().x() *= -1.0f;
    }
    if (scaleOfFit(mirrored, settings_))
      return kss::misfitButMirrored();
  }
  if (settings_.estimate_scale)
    return "";
  const auto source = pcl::make_shared<PointCloudSource>();
  copyIndexedSource(*source);
  const auto radiusOf = [](const auto& cloud) {
    return kss::bulkOf(cloud, kss::finiteIndices(cloud, kss::allIndices(cloud))).radius;
  };
  const double ratio = radiusOf(*target_) / (given_scale * radiusOf(*source));
  if (std::abs(std::log(ratio)) < std::log(kss::same_size))
    return "";
  kss::Settings any_scale = settings_;
  any_scale.estimate_scale = true;
  const std::optional<double> fitting = scaleOfFit(source, any_scale);
  return fitting ? kss::misfitButScaled(*fitting, given_scale) : "";
}

template <typename PointSource, typename PointTarget, typename Scalar>
std::optional<double>
KSSICP<PointSource, PointTarget, Scalar>::scaleOfFit(
    const PointCloudSourceConstPtr& source, const kss::Settings& settings)
try {
  KSSICP other;
  other.explains_misfits_ = false;
  other.settings_ = settings;
  other.settings_.progress = {};
  // what is known of the target; dropped with the other where that fails
  if (alignment_ && kss::sameWork(alignment_->settings(), other.settings_))
    other.alignment_ = std::move(alignment_);
  other.setInputSource(source);
  other.setInputTarget(target_);
  other.setSearchMethodTarget(tree_, true);
  // not align(), which would heed a signal of its own: this one's ends it, too
  if (!other.initCompute())
    return {};
  other.registerClouds(Matrix4::Identity());
  if (other.alignment_ && kss::sameWork(other.alignment_->settings(), settings_))
    alignment_ = std::move(other.alignment_);
  if (!other.converged_)
    return {};
  return other.getScale();
}
catch (const std::exception&) {
  return {}; // it determines no pose, or has to end
}

} // namespace pcl
