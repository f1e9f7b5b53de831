/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "distances.h"

#include <pcl/registration/kss/detail/usable_points.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace tool {
namespace {

/** The value below which a share of all lies. */
double
quantile(std::vector<double> values, double share)
{
  const auto nth = values.begin() + std::lround(share * (values.size() - 1.0));
  std::nth_element(values.begin(), nth, values.end());
  return *nth;
}

/** The next number of 1, 1.5, 2, 3 or 5 times a power of ten that is no smaller. */
double
roundedUp(double value)
{
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  for (const double factor : {1.0, 1.5, 2.0, 3.0, 5.0})
    if (value <= factor * power * (1.0 + 1e-9))
      return factor * power;
  return 10.0 * power;
}

/** An order in which points that follow each other lie close together: neighbours ask
 * for the same. */
std::vector<std::size_t>
orderInSpace(const Points& points)
{
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), 0);
  const auto local = [&](std::size_t i) -> Eigen::Vector3d {
    return points[i] - points.front();
  };
  pcl::kss::sortInSpace(local, order);
  return order;
}

} // namespace

NearestPoints::NearestPoints(const Points& points)
{
  Eigen::Vector3d low = points.front(), high = points.front();
  for (const auto& point : points) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  origin_ = 0.5 * (low + high);
  std::vector<float> coordinates;
  coordinates.reserve(3 * points.size());
  for (const auto& point : points)
    for (int axis = 0; axis < 3; ++axis)
      coordinates.push_back(static_cast<float>(point[axis] - origin_[axis]));
  tree_ = std::make_unique<pcl::kss::PackedTree>(coordinates.data(), 3, points.size());

  constexpr std::size_t ASKED = 2000;
  const std::size_t step = std::max<std::size_t>(1, points.size() / ASKED);
  std::vector<double> spacings;
  for (std::size_t i = 0; i < points.size(); i += step) {
    const pcl::kss::NearestTwo two = tree_->nearest(&coordinates[3 * i]);
    if (two.second >= 0 && two.second_squared > 0.0f) // copies tell nothing
      spacings.push_back(std::sqrt(two.second_squared));
  }
  if (!spacings.empty())
    spacing_ = quantile(std::move(spacings), 0.5);
}

double
NearestPoints::distanceFrom(const Eigen::Vector3d& position) const
{
  const Eigen::Vector3f local = (position - origin_).cast<float>();
  return std::sqrt(tree_->nearest(local.data()).squared);
}

Distances
distancesOf(const Points& points, const NearestPoints& others)
{
  Distances distances{};
  double sum = 0.0;
  distances.all.resize(points.size());
  for (const std::size_t i : orderInSpace(points)) {
    double& distance = distances.all[i];
    distance = others.distanceFrom(points[i]);
    sum += distance * distance;
  }
  distances.root_mean_square = std::sqrt(sum / points.size());
  distances.median = quantile(distances.all, 0.5);
  distances.most = quantile(distances.all, 0.95);
  distances.spacing = others.spacing();
  // what has no counterpart is to leave colours for what has
  const double close = std::max(distances.median, distances.spacing);
  // nor are they to show more than where which points happen to lie
  const double top =
      std::max(std::min(distances.most, 10.0 * close), 3.0 * distances.spacing);
  distances.top = top > 0.0 ? roundedUp(top) : 1.0;
  return distances;
}

} // namespace tool
