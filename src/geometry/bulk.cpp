/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include <pcl/registration/kss/detail/bulk.h>

#include "support/short_text.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace pcl {
namespace kss {
namespace {

double
medianOf(std::vector<double>& values)
{
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/** Radii whose squares, of a thousandth of them as of thousands of them, and sums of
 * thousands of squares are floats. */
constexpr double least_radius = 1e-12;
constexpr double most_radius = 1e12;

} // namespace

Bulk
bulkOf(std::vector<Eigen::Vector3d> some)
{
  std::sort(some.begin(), some.end(),
            [](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
              return std::lexicographical_compare(a.data(), a.data() + 3, b.data(),
                                                  b.data() + 3);
            });
  some.erase(std::unique(some.begin(), some.end()), some.end());

  Bulk bulk;
  std::vector<double> values(some.size());
  for (int axis = 0; axis < 3; ++axis) {
    std::transform(some.begin(), some.end(), values.begin(),
                   [axis](const Eigen::Vector3d& point) { return point[axis]; });
    bulk.middle[axis] = medianOf(values);
  }
  // not squared, which would overflow where the coordinates do not
  std::transform(some.begin(), some.end(), values.begin(),
                 [&bulk](const Eigen::Vector3d& point) {
                   return (point - bulk.middle).stableNorm();
                 });
  bulk.radius = medianOf(values);
  return bulk;
}

void
throwIfTooWide(const Bulk& bulk)
{
  if (bulk.radius > 0.0 && !(bulk.radius >= least_radius && bulk.radius <= most_radius))
    throw std::invalid_argument(
        "half of its points lie up to " + shortText(bulk.radius) +
        " from its middle, which single precision cannot square; bring it to a size "
        "between " +
        shortText(least_radius) + " and " + shortText(most_radius));
}

void
throwIfTooFar(const Bulk& bulk)
{
  const double largest = bulk.middle.cwiseAbs().maxCoeff();
  if (bulk.radius > 0.0 &&
      bulk.radius < std::numeric_limits<float>::epsilon() * largest)
    throw std::invalid_argument(
        "it lies " + shortText(largest) +
        " from the origin, where single precision rounds "
        "coordinates by more than its points lie apart; move it "
        "nearer");
}

} // namespace kss
} // namespace pcl
