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
#include "scans/local_features.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace pcl {
namespace kss {
namespace {

/** Points that show where a scan lies. */
constexpr std::size_t outline_points = 400;

/** The first ones of them show what its surface is like. */
constexpr std::size_t described_points = 256;

/** Features with no more digits than they are worth: there are many of them. */
std::vector<LocalFeature>
rounded(const Eigen::MatrixXf& features)
{
  std::vector<LocalFeature> all(features.cols());
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t j = 0; j < all[i].size(); ++j)
      all[i][j] = static_cast<std::uint8_t>(std::lround(255.0f * features(j, i)));
  return all;
}

/** How far neighbouring points are apart, usually. */
double
gapOf(const Points& points)
{
  Eigen::VectorXf squared(points.cols());
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    Eigen::RowVectorXf all = (points.colwise() - points.col(i)).colwise().squaredNorm();
    all[i] = std::numeric_limits<float>::max();
    squared[i] = all.minCoeff();
  }
  return std::sqrt(median(squared));
}

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
  const auto first = [&order](std::size_t most) {
    return std::vector<int>(order.begin(),
                            order.begin() + std::min(most, order.size()));
  };
  Points outline = take(points, first(outline_points));
  const Eigen::Matrix3Xd placed = points.cast<double>().colwise() + prepared.origin;
  description.centroid = placed.rowwise().mean();
  outline.colwise() -= (description.centroid - prepared.origin).cast<float>();
  description.outline.assign(outline.colwise().begin(), outline.colwise().end());
  description.gap = gapOf(outline);
  description.reach = outline.colwise().norm().maxCoeff();
  const Eigen::Matrix3Xd centred = placed.colwise() - description.centroid;
  description.spread = centred * centred.transpose() / centred.cols();

  // octaves of lengths, so that scans of different sizes have some in common
  description.octave = static_cast<int>(
      std::floor(std::log2(std::sqrt(description.spread.trace()) / 2.0)));
  const std::vector<int> described = first(described_points);
  const Points normals = normalsOf(points, prepared.surface.neighbourhoods, 1);
  const auto features = [&](int octave) {
    return rounded(localFeatures(points, normals, described,
                                 static_cast<float>(std::ldexp(1.0, octave))));
  };
  description.wide_features = features(description.octave);
  description.narrow_features = features(description.octave - 1);
  return description;
}

} // namespace kss
} // namespace pcl
