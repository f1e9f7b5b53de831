/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "preparation/prepared_cloud.h"

#include "geometry/median.h"
#include "geometry/take.h"
#include "preparation/cleaning.h"
#include "preparation/given_normals.h"
#include "preparation/simplification.h"

#include <algorithm>
#include <vector>

namespace pcl {
namespace kss {
namespace {

/** Points of a cloud that take part in refinement and judgement at most. */
constexpr std::size_t most_points = 12000;

/** Points of a cloud that judge poses at most: those of an object show all of its
 * surface; a scene shares little of its own, and of what it has there are many. */
constexpr std::size_t most_object_points = 40000, most_scene_points = 100000;

/** By how much more of the normals of fewer points have to agree with their neighbours'
 * for them to judge: so much more is due to noise, and several standard errors of the
 * share. Fewer points of a surface alone have normals that agree less. */
constexpr double clearly = 0.015;

/** Means of a noisy cloud. */
constexpr unsigned int most_means = 2500;

/** So many points of a cloud at most, clean where the settings want that. */
Surface
surfaceOf(const Points& cloud, std::size_t most, const Settings& settings)
{
  const Points points = withoutCopies(thinned(cloud, most));
  if (settings.clean)
    return withoutStrayPoints(points, settings.threads);
  return {points, neighbourhoodsOf(points, known_neighbours, settings.threads)};
}

/** The planes of a surface.
 * \param[in] cloud that it is of, which may have normals of its own */
TangentPlanes
planesOf(const Surface& surface, const LocalCloud& cloud, const Settings& settings)
{
  const auto& [points, neighbourhoods] = surface;
  TangentPlanes planes;
  planes.normals = normalsOf(points, neighbourhoods, settings.threads);
  planes.has_sides = takeGivenNormals(cloud, surface, planes.normals);
  measureTrust(points, neighbourhoods, settings.threads, planes);
  return planes;
}

/** The share of points whose normals agree with those of their neighbours. */
double
agreeingShare(const TangentPlanes& planes)
{
  return (planes.agreements.array() >= agreeing).cast<double>().mean();
}

/** Have as many points judge as have normals: those of noisy points close together are
 * those of the noise, the same noise turns normals less where points lie farther apart.
 */
void
takeWhatJudges(const LocalCloud& cloud,
               const Settings& settings,
               PreparedCloud& prepared)
{
  prepared.dense = prepared.surface;
  prepared.planes = planesOf(prepared.surface, cloud, settings);
  if (static_cast<std::size_t>(cloud.points.cols()) <= most_points)
    return;
  // the scales of scenes are known
  const bool scale_is_known =
      !settings.estimate_scale || settings.smallest_scale >= settings.largest_scale;
  Surface dense = surfaceOf(
      cloud.points, scale_is_known ? most_scene_points : most_object_points, settings);
  TangentPlanes planes = planesOf(dense, cloud, settings);
  if (agreeingShare(prepared.planes) > agreeingShare(planes) + clearly)
    return;
  prepared.dense = std::move(dense);
  prepared.planes = std::move(planes);
}

FarthestOrder
orderOf(const Points& points, const Settings& settings)
{
  // the other simplifications choose otherwise
  return settings.density == Density::UNIFORM
             ? inFarthestOrder(points, settings.sample_points)
             : FarthestOrder();
}

} // namespace

PreparedCloud
prepared(const LocalCloud& cloud,
         const Fingerprint& fingerprint,
         const Settings& settings)
{
  PreparedCloud prepared;
  prepared.fingerprint = fingerprint;
  prepared.origin = cloud.origin;
  prepared.surface = surfaceOf(cloud.points, most_points, settings);
  prepared.is_noisy = settings.clean && isNoisy(prepared.surface, settings.threads);
  takeWhatJudges(cloud, settings, prepared);
  prepared.order = orderOf(prepared.surface.points, settings);
  return prepared;
}

void
averageNoise(PreparedCloud& source, PreparedCloud& target, const Settings& settings)
{
  averageNoise(source.surface.points, target.surface.points, most_means,
               settings.threads);
  for (PreparedCloud* cloud : {&source, &target}) {
    cloud->surface.neighbourhoods =
        neighbourhoodsOf(cloud->surface.points, known_neighbours, settings.threads);
    cloud->dense = cloud->surface;
    cloud->planes = planesOf(cloud->dense, {}, settings);
    // the means of two noisy samplings lie about that far off each other's planes
    cloud->planes.noise = 0.5f * median(spacingOf(cloud->dense.neighbourhoods));
    cloud->order = orderOf(cloud->surface.points, settings);
  }
}

std::pair<Points, Points>
simplified(const PreparedCloud& source,
           const PreparedCloud& target,
           const Settings& settings)
{
  if (settings.density != Density::UNIFORM) {
    const auto simple = [&](const PreparedCloud& cloud) {
      return simplify(cloud.surface.points, settings.sample_points, settings.density,
                      settings.threads);
    };
    return {simple(source), simple(target)};
  }
  // a cloud of very few points must not take the other's shape from it
  const auto even = [](const PreparedCloud& cloud) {
    return std::max(evenSampleSize(cloud.order, cloud.surface.neighbourhoods),
                    fewest_samples);
  };
  const std::size_t k = std::min(even(source), even(target));
  const auto first = [k](const PreparedCloud& cloud) {
    const std::vector<int>& order = cloud.order.indices;
    return take(cloud.surface.points,
                {order.begin(), order.begin() + std::min(k, order.size())});
  };
  return {first(source), first(target)};
}

} // namespace kss
} // namespace pcl
