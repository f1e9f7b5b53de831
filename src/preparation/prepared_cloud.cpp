/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "preparation/prepared_cloud.h"

#include "geometry/take.h"
#include "preparation/cleaning.h"
#include "preparation/simplification.h"

#include <algorithm>
#include <vector>

namespace pcl {
namespace kss {
namespace {

/** Points of a cloud that take part in refinement and judgement at most. */
constexpr std::size_t most_points = 12000;

/** Means of a noisy cloud. */
constexpr unsigned int most_means = 2500;

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
prepared(const LocalCloud& cloud, const Settings& settings)
{
  PreparedCloud prepared;
  prepared.input = cloud;
  const Points points = withoutCopies(thinned(cloud.points, most_points));
  if (settings.clean) {
    prepared.surface = withoutStrayPoints(points, settings.threads);
    prepared.is_noisy = isNoisy(prepared.surface.points, settings.threads);
  }
  else
    prepared.surface = {points,
                        neighbourhoodsOf(points, known_neighbours, settings.threads)};
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
