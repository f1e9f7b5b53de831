/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "scans/description.h"

#include "geometry/median.h"
#include "geometry/neighbourhoods.h"
#include "geometry/take.h"
#include "geometry/tangent_planes.h"
#include "preparation/prepared_cloud.h"
#include "prepared_scan.h"
#include "scans/pair_features.h"

#include <algorithm>

namespace pcl {
namespace kss {
namespace {

/** Points that show where a scan lies. */
constexpr std::size_t outline_points = 400;

} // namespace

ScanDescription
descriptionOf(const PreparedScan& scan)
{
  const PreparedCloud& prepared = *scan.prepared;
  const Points& points = prepared.surface.points;
  ScanDescription description;
  description.far_points = scan.far;
  description.spacing = median(spacingOf(prepared.dense.neighbourhoods));
  const std::vector<int>& order = prepared.order.indices;
  description.outline = take(
      points, {order.begin(), order.begin() + std::min(outline_points, order.size())});
  const Eigen::Matrix3Xd placed = points.cast<double>().colwise() + prepared.origin;
  description.centroid = placed.rowwise().mean();
  description.outline.colwise() -=
      (description.centroid - prepared.origin).cast<float>();
  const Eigen::Matrix3Xd centred = placed.colwise() - description.centroid;
  description.spread = centred * centred.transpose() / centred.cols();
  return description;
}

} // namespace kss
} // namespace pcl
