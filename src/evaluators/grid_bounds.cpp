/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "evaluators/grid_bounds.h"

#include <algorithm>
#include <cmath>

namespace pcl {
namespace kss {
namespace {

/** How far around the clouds distances are told apart where they count up to a limit.
 */
constexpr double margin_in_limits = 1.5;

double
radiusOf(const Points& cloud)
{
  return std::sqrt(cloud.colwise().squaredNorm().maxCoeff());
}

} // namespace

void
GridBounds::setClouds(const Points& source,
                      const Points& target,
                      const BoundsScope& scope)
{
  scope_ = scope;
  source_ = source;
  target_ = target;
  probes_.clear();
  const double source_radius = radiusOf(source), target_radius = radiusOf(target);
  // a placed source point, and a target point in the frame of the source
  const double forth = scope.largest_scale * source_radius + scope.largest_shift;
  const double back = (target_radius + scope.largest_shift) / scope.smallest_scale;
  const auto gridFor = [&](const Points& cloud, double radius, double reach,
                           double limit) {
    const auto largest = static_cast<float>(std::max(radius, reach));
    // farther than the limit, since a probe that far may stand for nearer points
    const double margin = margin_in_limits * limit;
    return scope.beyond_limit || margin > reach
               ? gridWithin(static_cast<float>(reach), scope.nodes, largest)
               : gridAround(cloud, static_cast<float>(margin), scope.nodes, largest);
  };
  if (scope.source_to_target)
    setCells(false, target, gridFor(target, target_radius, forth, scope.limit));
  if (scope.target_to_source)
    setCells(true, source,
             gridFor(source, source_radius, back, scope.limit / scope.smallest_scale));
  // of positions in either frame, seen in that of the target
  absolute_error_ = roundingOf(static_cast<float>(
      2.0 * (forth + target_radius + scope.largest_scale * (back + source_radius))));
  // of sums, one term after the other
  relative_error_ = std::numeric_limits<float>::epsilon() *
                    (16.0f + 0.5f * std::max(source.cols(), target.cols()));
}

std::vector<DistanceBounds>
GridBounds::evaluate(const std::vector<Placement>& placements, Eigen::Index probes)
{
  if (placements.empty())
    return {};
  auto found = probes_.find(probes);
  if (found == probes_.end()) {
    ProbesOfBoth both;
    if (scope_.source_to_target)
      both.source = probesOf(source_, probes);
    if (scope_.target_to_source)
      both.target = probesOf(target_, probes);
    found = probes_.emplace(probes, both).first;
  }
  // where probes stand for others, these leave the larger part of the slack
  const bool all = probes >= std::max(source_.cols(), target_.cols());
  auto bounds = lookedUp(placements, found->second, all, scope_.limit);
  const auto widen = [this](float& lower, float& upper) {
    lower = std::max(0.0f, lower * (1.0f - relative_error_) - absolute_error_);
    upper = upper * (1.0f + relative_error_) + absolute_error_;
  };
  for (DistanceBounds& b : bounds) {
    widen(b.lower.source_to_target, b.upper.source_to_target);
    widen(b.lower.mean_source_to_target, b.upper.mean_source_to_target);
    widen(b.lower.target_to_source, b.upper.target_to_source);
    widen(b.lower.mean_target_to_source, b.upper.mean_target_to_source);
  }
  return bounds;
}

} // namespace kss
} // namespace pcl
