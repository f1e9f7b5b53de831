/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "geometry/nearest_points.h"

#include "geometry/clouds.h"
#include "geometry/median.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pcl {
namespace kss {
namespace {

/** Cells a few spacings wide: small enough for a short way to the nearest point, few
 * enough to be set up quickly. */
DistanceField
fieldFor(const Points& points)
{
  const float extent = longestEdge(points);
  const float cell = extent > 0.0f ? extent / 48.0f * coarseness(points) : 1.0f;
  return DistanceField(points, cell, 2.0f * cell);
}

} // namespace

NearestPoints::NearestPoints(const Points& points, unsigned int threads)
: NearestPoints(points, neighbourhoodsOf(points, neighbours, threads))
{
}

NearestPoints::NearestPoints(Points points,
                             const Neighbourhoods& neighbourhoods,
                             float unit)
: points_(std::move(points))
, around_(points_.cols())
, spacing_(spacingOf(neighbourhoods) / unit)
, usual_spacing_(median(spacing_))
, middle_(points_.rowwise().mean())
, radius_(rootMeanSquareRadius(points_, middle_))
, field_(fieldFor(points_))
{
  const Eigen::MatrixXi& indices = neighbourhoods.indices;
  for (Eigen::Index i = 0; i < points_.cols(); ++i)
    for (int n = 0; n < neighbours; ++n) {
      const int other = n < indices.rows() ? indices(n, i) : static_cast<int>(i);
      around_[i].x[n] = points_(0, other);
      around_[i].y[n] = points_(1, other);
      around_[i].z[n] = points_(2, other);
      around_[i].indices[n] = other;
    }
}

} // namespace kss
} // namespace pcl
