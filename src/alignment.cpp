/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include <pcl/registration/kss/alignment.h>
#include <pcl/registration/kss/naming.h>
#include <pcl/registration/kss/stopping.h>

#include "clouds.h"
#include "median.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl {
namespace kss {
namespace {

/** How far the size of a part can be from that of the whole. */
constexpr double smallest_part = 0.35;

/** What tells whether a cloud determines a pose. */
CloudSize
sizeOf(const PreparedCloud& cloud, const PreShape& shape)
{
  return {longestEdge(cloud.surface.points), shape.size,
          median(spacingOf(cloud.surface.neighbourhoods))};
}

} // namespace

Alignment::Alignment(const Settings& settings)
: settings_(settings)
, search_(settings)
{
}

Alignment::~Alignment() = default;

void
Alignment::setClouds(const LocalCloud& source,
                     const LocalCloud& target,
                     double known_scale)
{
  clock_.restart();
  report("preparation", 0.0);
  prepare(target_cloud_, target);
  report("preparation", 0.5);
  prepare(source_cloud_, source);
  is_noisy_ = source_cloud_.is_noisy || target_cloud_.is_noisy;
  if (is_noisy_) {
    PreparedCloud mean_source = source_cloud_, mean_target = target_cloud_;
    averageNoise(mean_source, mean_target, settings_);
    toPreShapeSpace(mean_source, mean_target, known_scale);
  }
  else
    toPreShapeSpace(source_cloud_, target_cloud_, known_scale);
}

void
Alignment::prepare(PreparedCloud& prepared_cloud, const LocalCloud& cloud)
{
  const LocalCloud& known = prepared_cloud.input;
  if (!areEqual(known.points, cloud.points) || known.origin != cloud.origin)
    prepared_cloud = prepared(cloud, settings_);
}

void
Alignment::toPreShapeSpace(const PreparedCloud& source,
                           const PreparedCloud& target,
                           double known_scale)
{
  report("preparation", 1.0);
  clock_.lap("preparation");
  report("simplification", 0.0);
  const auto [few_source, few_target] = simplified(source, target, settings_);
  PreShape small_source = naming("source", [&, &points = few_source] {
    return toPreShape({points, source.input.origin});
  });
  const PreShape small_target = naming("target", [&, &points = few_target] {
    return toPreShape({points, target.input.origin});
  });
  const double scale =
      settings_.estimate_scale
          ? ScaleRange{settings_.smallest_scale, settings_.largest_scale}.clamp(
                small_target.size / small_source.size)
          : known_scale;
  source_size_ = sizeOf(source, small_source);
  target_size_ = sizeOf(target, small_target);
  throwIfUndetermined(scale);
  if (!settings_.estimate_scale)
    small_source = withSize(small_source, small_target.size / known_scale);
  search_.setClouds(small_source.points, small_target.points);
  metric_.emplace(small_source.points);
  const auto set = [](std::optional<Shape>& shape, const PreShape& small,
                      const PreparedCloud& cloud) {
    const Eigen::Vector3f center = (small.center - cloud.input.origin).cast<float>();
    const auto size = static_cast<float>(small.size);
    const Neighbourhoods& neighbourhoods = cloud.surface.neighbourhoods;
    const Surface surface{(cloud.surface.points.colwise() - center) / size,
                          {neighbourhoods.indices, neighbourhoods.distances / size}};
    if (shape && areEqual(shape->all.points(), surface.points))
      shape->simplified = small;
    else
      shape.emplace(Shape{small, NearestPoints(surface)});
  };
  set(source_, small_source, source);
  set(target_, small_target, target);
  report("simplification", 1.0);
  clock_.lap("simplification");
}

Alternatives
Alignment::align()
{
  // E_d of (e9) or E_cd of (e122) for all candidates, and their minima
  report("search", 0.0);
  const std::vector<Minimum> minima = search_.localMinima(
      scaleRange(), *metric_, [this](double done) { report("search", done); });
  report("search", 1.0);
  clock_.lap("search");
  // T O_init of (e11); the additional process of (e12) where it is not good enough
  report("refinement", 0.0);
  const Selection selection(*source_, *target_, *metric_, scaleRange(), is_noisy_,
                            settings_.threads);
  const Minimum& initial = minima.front();
  std::vector<JudgedPose> judged;
  if (settings_.additional_process_threshold > 0.0)
    judged = selection.best({initial.pose}, [](double) {});
  if (judged.empty() || !isGoodEnough(judged.front(), initial.weights)) {
    std::vector<Eigen::Matrix4d> poses;
    for (const Minimum& minimum : minima)
      poses.push_back(minimum.pose);
    judged = selection.best(poses, [this](double done) { report("refinement", done); });
  }
  Alternatives alternatives;
  for (const JudgedPose& candidate : judged)
    alternatives.push_back(
        {fromPreShape(candidate.pose, source_->simplified, target_->simplified),
         candidate.overlap});
  report("refinement", 1.0);
  clock_.lap("refinement");
  return alternatives;
}

bool
Alignment::isGoodEnough(const JudgedPose& judged, const Weights& weights)
try {
  return search_.energyAt(judged.pose, weights) <=
         settings_.additional_process_threshold;
}
catch (const Stopped&) {
  return true; // it has to be
}

ScaleRange
Alignment::scaleRange() const
{
  if (!settings_.estimate_scale)
    return {1.0, 1.0};
  const double unit = source_->simplified.size / target_->simplified.size;
  const ScaleRange asked{settings_.smallest_scale * unit,
                         settings_.largest_scale * unit};
  const ScaleRange range{std::max(smallest_part, asked.smallest),
                         std::min(1.0 / smallest_part, asked.largest)};
  return range.smallest <= range.largest ? range : asked;
}

void
Alignment::throwIfUndetermined(double scale) const
{
  kss::throwIfUndetermined(source_size_, target_size_, scale);
}

Alternative
Alignment::judge(const Eigen::Matrix4d& transformation) const
{
  if (!isSimilarity(transformation) ||
      !isDetermined(source_size_, target_size_, scaleOf(transformation)))
    return {transformation, {}};
  return {transformation, overlapAt(source_->all, target_->all,
                                    toPreShapePose(transformation, source_->simplified,
                                                   target_->simplified))};
}

bool
Alignment::same(const Eigen::Matrix4d& a, const Eigen::Matrix4d& b) const
{
  return metric_->distance(
             toPreShapePose(a, source_->simplified, target_->simplified),
             toPreShapePose(b, source_->simplified, target_->simplified)) < same_pose;
}

double
Alignment::spacing(const Eigen::Matrix4d& transformation) const
{
  return std::max(scaleOf(transformation) * source_->simplified.size *
                      median(source_->all.spacing()),
                  target_->simplified.size * median(target_->all.spacing()));
}

std::string
Alignment::deviceName() const
{
  return search_.deviceName();
}

StageClock&
Alignment::clock()
{
  return clock_;
}

void
Alignment::report(const char* stage, double done) const
{
  if (settings_.progress)
    settings_.progress(stage, done);
}

} // namespace kss
} // namespace pcl
