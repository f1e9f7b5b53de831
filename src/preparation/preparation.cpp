/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "preparation/preparation.h"

#include "geometry/clouds.h"

namespace pcl {
namespace kss {

Preparation::Preparation(const Settings& settings)
: settings_(settings)
{
}

PreparedPair
Preparation::prepared(const LocalCloud& source,
                      const LocalCloud& target,
                      const std::function<void(double)>& done)
{
  bringUpToDate(target_, target);
  done(0.5);
  bringUpToDate(source_, source);
  if (!source_->is_noisy && !target_->is_noisy)
    return {source_, target_, false};
  const auto mean_source = std::make_shared<PreparedCloud>(*source_);
  const auto mean_target = std::make_shared<PreparedCloud>(*target_);
  averageNoise(*mean_source, *mean_target, settings_);
  return {mean_source, mean_target, true};
}

void
Preparation::bringUpToDate(std::shared_ptr<const PreparedCloud>& kept,
                           const LocalCloud& cloud)
{
  if (!kept || !areEqual(kept->input.points, cloud.points) ||
      !areEqual(kept->input.normals, cloud.normals) ||
      kept->input.origin != cloud.origin)
    kept = std::make_shared<PreparedCloud>(kss::prepared(cloud, settings_));
}

} // namespace kss
} // namespace pcl
