/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "support/units.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

namespace pcl {
namespace kss {
namespace {

/** How far sizes of two clouds of one object differ by their sampling at most, as the
 * logarithm of a factor; also less than half of what lies between two of the units. */
constexpr double sampling = 0.08;

/** Two units, and how many of the fine one make a coarse one. */
struct Units {
  double factor;
  const char *fine, *coarse;
};

constexpr std::array<Units, 11> known_units{{{1000.0, "millimetres", "metres"},
                                             {100.0, "centimetres", "metres"},
                                             {10.0, "millimetres", "centimetres"},
                                             {25.4, "millimetres", "inches"},
                                             {2.54, "centimetres", "inches"},
                                             {304.8, "millimetres", "feet"},
                                             {30.48, "centimetres", "feet"},
                                             {12.0, "inches", "feet"},
                                             {39.37, "inches", "metres"},
                                             {3.281, "feet", "metres"},
                                             {1e6, "micrometres", "metres"}}};

} // namespace

std::string
questionOfUnits(const std::string& large, const std::string& small, double factor)
{
  const auto distance = [factor](const Units& units) {
    return std::abs(std::log(factor / units.factor));
  };
  const auto* nearest = std::min_element(
      known_units.begin(), known_units.end(),
      [&](const Units& a, const Units& b) { return distance(a) < distance(b); });
  if (distance(*nearest) > sampling)
    return "is one of them in another unit, such as millimetres";
  return "is the " + large + " in " + nearest->fine + " and the " + small + " in " +
         nearest->coarse;
}

} // namespace kss
} // namespace pcl
