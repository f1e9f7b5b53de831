/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include <pcl/registration/kss/result.h>

#include <algorithm>
#include <cmath>

namespace pcl {
namespace kss {
namespace {

// fitted by evaluation/confidence/fit.py on the cases made there; see docs/confidence.md
constexpr double odds_constant = -0.469;
constexpr double odds_of_worst = 0.951;
constexpr double odds_of_consistent = 1.569;
constexpr double odds_of_residual = 0.0;
constexpr double odds_of_score = 2.973;
constexpr double confidence_constant = -0.639;
constexpr double confidence_of_odds = 0.885;
constexpr double confidence_of_margin = 0.907;

/** Shares and residuals beyond which a logarithm, or more of them, says nothing. */
constexpr double least_worst = 0.005;
constexpr double least_consistent = 0.02;
constexpr double most_residual = 3.0;
constexpr double most_margin = 8.0;

/** Poses whose log odds differ by less are about equally good: two samplings of one
 * symmetric shape differ by less. */
constexpr double equally_good = 0.7;

/** The share of a complete cloud that another complete one covers at least. */
constexpr double complete = 0.9;

} // namespace

double
logOddsOf(const Alternative& alternative)
{
  const auto& [source, target, residual, noise, reach] = alternative.evidence;
  return odds_constant +
         odds_of_worst * std::log(std::max(source.worst, target.worst) + least_worst) +
         odds_of_consistent *
             std::log((source.consistent + least_consistent) *
                      (target.consistent + least_consistent)) /
             2.0 +
         odds_of_residual * std::min(residual, most_residual) +
         odds_of_score * alternative.overlap.score;
}

double
confidenceOf(const Alternatives& alternatives)
{
  if (alternatives.empty())
    return 0.0;
  const double odds = logOddsOf(alternatives[0]);
  const double margin = alternatives.size() > 1
                            ? std::abs(odds - logOddsOf(alternatives[1]))
                            : most_margin;
  const double all = confidence_constant + confidence_of_odds * odds +
                     confidence_of_margin * std::log1p(std::min(margin, most_margin));
  // no more than so many witnesses can say: Laplace's rule of succession
  const Evidence& evidence = alternatives[0].evidence;
  const double witnesses = std::min(evidence.source.points, evidence.target.points);
  return std::min(1.0 / (1.0 + std::exp(-all)), (witnesses + 1.0) / (witnesses + 2.0));
}

bool
areEquallyGood(const Alternative& a, const Alternative& b)
{
  return std::abs(logOddsOf(a) - logOddsOf(b)) < equally_good;
}

bool
isAmbiguous(const Alternatives& alternatives)
{
  return alternatives.size() > 1 && logOddsOf(alternatives[0]) >= 0.0 &&
         areEquallyGood(alternatives[0], alternatives[1]);
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
