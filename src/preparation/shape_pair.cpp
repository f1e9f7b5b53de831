/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "preparation/shape_pair.h"

#include <pcl/registration/kss/detail/naming.h>

#include "geometry/clouds.h"
#include "geometry/median.h"
#include "support/parallel.h"

#include <algorithm>
#include <utility>

namespace pcl {
namespace kss {
namespace {

/** How far the size of a part can be from that of the whole. */
constexpr double smallest_part = 0.35;

PreShape
simplifiedShape(const char* name, const Points& points, const PreparedCloud& cloud)
{
  return naming(name, [&] { return toPreShape({points, cloud.origin}); });
}

CloudSize
sizeOf(const PreparedCloud& cloud, const PreShape& simplified)
{
  return {longestEdge(cloud.surface.points), simplified.size,
          median(spacingOf(cloud.surface.neighbourhoods))};
}

/** Points in the frame of the simplified ones. */
std::shared_ptr<const NearestPoints>
inFrameOf(const PreShape& simplified,
          const Eigen::Vector3d& origin,
          const Surface& cloud,
          const std::shared_ptr<const NearestPoints>& before)
{
  const Eigen::Vector3f center = (simplified.center - origin).cast<float>();
  const auto size = static_cast<float>(simplified.size);
  Points points = (cloud.points.colwise() - center) / size;
  if (before && areEqual(before->points(), points))
    return before;
  return std::make_shared<NearestPoints>(std::move(points), cloud.neighbourhoods, size);
}

/** A prepared cloud in pre-shape space.
 * \param[in] before what may be kept of it; null: nothing */
Shape
shapeOf(const PreShape& simplified,
        const PreparedCloud& cloud,
        const CloudSize& extent,
        const Shape* before)
{
  const auto place = [&](const Surface& surface, const auto& known) {
    return inFrameOf(simplified, cloud.origin, surface, known);
  };
  Shape shape{simplified, nullptr, {}, extent};
  shape.all = place(cloud.surface, before ? before->all : nullptr);
  shape.surface.points =
      areEqual(cloud.dense.points, cloud.surface.points)
          ? shape.all
          : place(cloud.dense, before ? before->surface.points : nullptr);
  shape.surface.planes = cloud.planes;
  shape.surface.planes.deviations /= static_cast<float>(simplified.size);
  shape.surface.planes.noise /= static_cast<float>(simplified.size);
  return shape;
}

ScaleRange
scalesBetween(const PreShape& source, const PreShape& target, const Settings& settings)
{
  if (!settings.estimate_scale)
    return {1.0, 1.0};
  const double unit = source.size / target.size;
  const ScaleRange asked{settings.smallest_scale * unit, settings.largest_scale * unit};
  const ScaleRange range{std::max(smallest_part, asked.smallest),
                         std::min(1.0 / smallest_part, asked.largest)};
  return range.smallest <= range.largest ? range : asked;
}

} // namespace

std::shared_ptr<const ShapePair>
shapePair(const PreparedPair& clouds,
          const std::optional<double>& guessed_scale,
          const Settings& settings,
          const ShapePair* before)
{
  const auto [few_source, few_target] =
      simplified(*clouds.source, *clouds.target, settings);
  PreShape source = simplifiedShape("source", few_source, *clouds.source);
  const PreShape target = simplifiedShape("target", few_target, *clouds.target);
  const CloudSize source_size = sizeOf(*clouds.source, source);
  const CloudSize target_size = sizeOf(*clouds.target, target);
  const double known_scale = guessed_scale.value_or(1.0);
  throwIfUndetermined(
      source_size, target_size,
      settings.estimate_scale
          ? ScaleRange{settings.smallest_scale, settings.largest_scale}.clamp(
                target.size / source.size)
          : known_scale);
  if (guessed_scale && settings.estimate_scale)
    throwIfUndetermined(source_size, target_size, *guessed_scale);
  if (!settings.estimate_scale)
    source = withSize(source, target.size / known_scale);
  Shape shapes[2];
  inParallel(2, settings.threads, 1, [&](std::ptrdiff_t i) {
    shapes[i] = i == 0 ? shapeOf(source, *clouds.source, source_size,
                                 before ? &before->source : nullptr)
                       : shapeOf(target, *clouds.target, target_size,
                                 before ? &before->target : nullptr);
  });
  return std::make_shared<ShapePair>(
      ShapePair{std::move(shapes[0]), std::move(shapes[1]), PoseMetric(source.points),
                scalesBetween(source, target, settings), settings.rotation_axis,
                clouds.is_noisy});
}

} // namespace kss
} // namespace pcl
