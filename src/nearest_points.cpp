/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include <pcl/registration/kss/nearest_points.h>

#include <algorithm>
#include <cmath>

namespace pcl {
namespace kss {
namespace {

/** Enough for every direction to have a neighbour in it. */
constexpr int neighbours = 10;

/** Cells a few spacings wide: small enough for a short way to the nearest point, few
 * enough to be set up quickly. */
float
cellFor(const Points& points)
{
  const float extent =
      (points.rowwise().maxCoeff() - points.rowwise().minCoeff()).maxCoeff();
  return extent > 0.0f ? extent / 48.0f : 1.0f;
}

} // namespace

NearestPoints::NearestPoints(const Points& points, unsigned int threads)
: points_(points)
, neighbourhoods_(neighbourhoodsOf(points, neighbours, threads))
, spacing_(spacingOf(neighbourhoods_))
, field_(points, cellFor(points), 2.0f * cellFor(points))
{
}

} // namespace kss
} // namespace pcl
