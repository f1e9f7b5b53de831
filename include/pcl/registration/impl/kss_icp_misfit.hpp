/*
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * Where nothing fits: whether another source, or another scale, does.
 */

#pragma once

#include <pcl/registration/kss_icp.h>

namespace pcl {

template <typename PointSource, typename PointTarget, typename Scalar>
std::optional<double>
KSSICP<PointSource, PointTarget, Scalar>::scaleOfFit(kss::Mirror mirror,
                                                     double given_scale,
                                                     const kss::Settings& settings)
try {
  const auto source = pcl::make_shared<PointCloudSource>();
  copyIndexedSource(*source);
  if (mirror)
    for (PointSource& point : *source) {
      point.getVector3fMap() *= static_cast<float>(given_scale);
      point.getVector3fMap()[*mirror] *= -1.0f;
      if constexpr (traits::has_normal<PointSource>::value)
        point.getNormalVector3fMap()[*mirror] *= -1.0f;
    }
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
