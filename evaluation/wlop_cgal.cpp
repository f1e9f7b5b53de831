/*
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * CGAL's point set processing is under the GPL: a program built with this file is, too.
 */

#include "resampling.h"

#include <CGAL/Simple_cartesian.h>
#include <CGAL/wlop_simplify_and_regularize_point_set.h>

#include <iterator>

namespace evaluation {
namespace {

using Point = CGAL::Simple_cartesian<double>::Point_3;

const SurfacePoint&
nearest(const SurfacePoints& points, const Eigen::Vector3d& position)
{
  const SurfacePoint* best = &points.front();
  for (const auto& point : points)
    if ((point.position - position).squaredNorm() <
        (best->position - position).squaredNorm())
      best = &point;
  return *best;
}

} // namespace

bool
hasWLOP()
{
  return true;
}

SurfacePoints
simplifiedByWLOP(const SurfacePoints& points, std::size_t number)
{
  std::vector<Point> original, simplified;
  for (const auto& point : points)
    original.emplace_back(point.position.x(), point.position.y(), point.position.z());
  CGAL::wlop_simplify_and_regularize_point_set<CGAL::Sequential_tag>(
      original, std::back_inserter(simplified),
      CGAL::parameters::select_percentage(100.0 * static_cast<double>(number) /
                                          static_cast<double>(points.size())));
  SurfacePoints result;
  for (const auto& point : simplified) {
    const Eigen::Vector3d position(point.x(), point.y(), point.z());
    result.push_back({position, nearest(points, position).normal});
  }
  return result;
}

} // namespace evaluation
