/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "preparation/preparation.h"

#include "support/parallel.h"

#include <algorithm>
#include <thread>
#include <vector>

namespace pcl {
namespace kss {

PreparedPair
pairOf(const std::shared_ptr<const PreparedCloud>& source,
       const std::shared_ptr<const PreparedCloud>& target,
       const Settings& settings)
{
  if (!source->is_noisy && !target->is_noisy)
    return {source, target, false};
  const auto mean_source = std::make_shared<PreparedCloud>(*source);
  const auto mean_target = std::make_shared<PreparedCloud>(*target);
  averageNoise(*mean_source, *mean_target, settings);
  return {mean_source, mean_target, true};
}

Preparation::Preparation(const Settings& settings)
: settings_(settings)
{
}

PreparedPair
Preparation::prepared(const LocalCloud& source,
                      const LocalCloud& target,
                      const std::function<void(double)>& done)
{
  struct Cloud {
    std::shared_ptr<const PreparedCloud>& kept;
    const LocalCloud& input;
    Fingerprint fingerprint;
  };
  std::vector<Cloud> to_prepare;
  for (const Cloud& cloud : {Cloud{target_, target, fingerprintOf(target)},
                             Cloud{source_, source, fingerprintOf(source)}})
    if (!cloud.kept || cloud.kept->fingerprint != cloud.fingerprint)
      to_prepare.push_back(cloud);

  // one beside the other, where there are threads for both
  Settings settings = settings_;
  if (to_prepare.size() > 1)
    settings.threads = std::max(1u, threadCount(settings_.threads) / 2);
  const auto caller = std::this_thread::get_id(); // who is told, once
  bool is_told = false;
  const auto tell = [&] {
    if (!is_told)
      done(0.5);
    is_told = true;
  };
  inParallel(to_prepare.size(), settings_.threads, 1, [&](std::ptrdiff_t i) {
    const Cloud& cloud = to_prepare[i];
    cloud.kept = std::make_shared<PreparedCloud>(
        kss::prepared(cloud.input, cloud.fingerprint, settings));
    if (std::this_thread::get_id() == caller)
      tell();
  });
  tell();
  return pairOf(source_, target_, settings_);
}

} // namespace kss
} // namespace pcl
