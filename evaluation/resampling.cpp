/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "resampling.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace evaluation {
namespace {

/** How much denser the one end is. */
constexpr double gradient = 20.0;

/** \brief Keep points with a probability that falls by the gradient from one end to the
 * other, in a random direction.
 */
SurfacePoints
thinnedTowardsOneEnd(const SurfacePoints& points, Random& random)
{
  const Eigen::Vector3d axis = direction(random);
  double least = std::numeric_limits<double>::max(), most = -least;
  for (const auto& point : points) {
    least = std::min(least, point.position.dot(axis));
    most = std::max(most, point.position.dot(axis));
  }
  SurfacePoints kept;
  for (const auto& point : points) {
    const double along = (point.position.dot(axis) - least) / (most - least);
    if (uniform(random, 0.0, 1.0) < std::pow(gradient, -along))
      kept.push_back(point);
  }
  return kept;
}

} // namespace

std::size_t
pointsToResample(std::size_t number, Resampling resampling)
{
  // Where most of the surface lies at the sparse end, a twentieth is kept.
  return resampling == Resampling::WLOP ? 2 * number
                                        : static_cast<std::size_t>(gradient) * number;
}

SurfacePoints
resampled(const SurfacePoints& points,
          std::size_t number,
          Resampling resampling,
          Random& random)
{
  SurfacePoints result = resampling == Resampling::WLOP
                             ? simplifiedByWLOP(points, number)
                             : thinnedTowardsOneEnd(points, random);
  result.resize(std::min(result.size(), number));
  return result;
}

} // namespace evaluation
