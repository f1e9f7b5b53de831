/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "preparation/preparation.h"

#include "geometry/clouds.h"
#include "support/parallel.h"

#include <algorithm>

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
  // one beside the other, where there are threads for both
  const unsigned int threads = threadCount(settings_.threads);
  Settings settings = settings_;
  settings.threads = std::max(1u, threads / 2);
  inParallel(2, threads, 1, [&](std::ptrdiff_t i) {
    if (i == 0)
      bringUpToDate(target_, target, settings);
    else
      bringUpToDate(source_, source, settings);
    if (threads == 1) // progress is told by the thread that has called
      done(0.5 * static_cast<double>(i + 1));
  });
  if (!source_->is_noisy && !target_->is_noisy)
    return {source_, target_, false};
  const auto mean_source = std::make_shared<PreparedCloud>(*source_);
  const auto mean_target = std::make_shared<PreparedCloud>(*target_);
  averageNoise(*mean_source, *mean_target, settings_);
  return {mean_source, mean_target, true};
}

void
Preparation::bringUpToDate(std::shared_ptr<const PreparedCloud>& kept,
                           const LocalCloud& cloud,
                           const Settings& settings)
{
  if (!kept || !areEqual(kept->input.points, cloud.points) ||
      !areEqual(kept->input.normals, cloud.normals) ||
      kept->input.origin != cloud.origin)
    kept = std::make_shared<PreparedCloud>(kss::prepared(cloud, settings));
}

} // namespace kss
} // namespace pcl
