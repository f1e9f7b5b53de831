/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include <pcl/registration/kss/result.h>

#include <algorithm>
#include <cmath>

namespace pcl {
namespace kss {
namespace {

/** Poses whose log odds differ by less are about equally good: two samplings of one
 * symmetric shape differ by less. */
constexpr double equally_good = 0.7;

/** The share of a complete cloud that another complete one covers at least. */
constexpr double complete = 0.9;

} // namespace

double
logOddsOf(const Evidence& evidence)
{
  const auto [worst, best] = std::minmax(evidence.source.worst, evidence.target.worst);
  const double consistent =
      std::min(evidence.source.consistent, evidence.target.consistent);
  return 2.0 * std::log((best + 0.005) / 0.08) + 0.5 * std::log((worst + 0.01) / 0.03) +
         1.0 * std::log((consistent + 0.02) / 0.1) - 3.0 * (evidence.residual - 1.3);
}

double
confidenceOf(const Evidence& evidence)
{
  return 1.0 / (1.0 + std::exp(-logOddsOf(evidence)));
}

bool
areEquallyGood(const Evidence& a, const Evidence& b)
{
  return std::abs(logOddsOf(a) - logOddsOf(b)) < equally_good;
}

bool
isAmbiguous(const Alternatives& alternatives)
{
  return alternatives.size() > 1 && logOddsOf(alternatives[0].evidence) >= 0.0 &&
         areEquallyGood(alternatives[0].evidence, alternatives[1].evidence);
}

Mode
modeOf(const Overlap& overlap)
{
  const bool source_is_part = overlap.source > complete;
  const bool target_is_part = overlap.target > complete;
  return source_is_part && target_is_part   ? Mode::GLOBAL_GLOBAL
         : source_is_part || target_is_part ? Mode::PARTIAL_GLOBAL
                                            : Mode::PARTIAL_PARTIAL;
}

std::string
misfitAt(const Evidence& evidence)
{
  const auto percent = [](double share) {
    return std::to_string(std::lround(100.0 * share)) + " %";
  };
  return "The clouds do not fit: at the best pose the other cloud's surface explains " +
         percent(evidence.source.explained) + " of the source and " +
         percent(evidence.target.explained) +
         " of the target, and too little that fixes the pose; do they show the same "
         "object?";
}

} // namespace kss
} // namespace pcl
