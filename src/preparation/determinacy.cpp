/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "preparation/determinacy.h"

#include <pcl/registration/kss/detail/naming.h>

#include "geometry/neighbourhoods.h"
#include "support/short_text.h"
#include "support/units.h"

#include <algorithm>
#include <utility>

namespace pcl {
namespace kss {
namespace {

void
throwIfTooSparse(const CloudSize& cloud)
{
  if (cloud.radius < covered * cloud.spacing)
    throw std::invalid_argument("its points are too few, " + shortText(cloud.spacing) +
                                " apart where it is " + shortText(cloud.extent) +
                                " wide");
}

} // namespace

bool
isDetermined(const CloudSize& source, const CloudSize& target, double scale)
{
  return scale * source.radius >= covered * target.spacing &&
         target.radius >= covered * scale * source.spacing;
}

void
throwIfUndetermined(const CloudSize& source, const CloudSize& target, double scale)
{
  naming("source", [&] { throwIfTooSparse(source); });
  naming("target", [&] { throwIfTooSparse(target); });
  if (isDetermined(source, target, scale))
    return;
  std::string large = "source", small = "target";
  double larger = scale * source.extent, smaller = target.extent;
  if (larger < smaller) {
    std::swap(large, small);
    std::swap(larger, smaller);
  }
  // a box changes with the way a cloud is turned, and would name no unit
  const double radii = scale * source.radius / target.radius;
  throw std::invalid_argument(
      (scale == 1.0 ? "The " : "At the scale " + shortText(scale) + ", the ") + large +
      " is " + shortText(larger / smaller) + " times as large as the " + small + " (" +
      shortText(larger) + " against " + shortText(smaller) +
      "), too large for a pose to be told: " +
      questionOfUnits(large, small, std::max(radii, 1.0 / radii)) +
      ", or is the scale to be estimated?");
}

} // namespace kss
} // namespace pcl
