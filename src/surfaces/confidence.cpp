/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include <pcl/registration/kss/result.h>

#include "geometry/relative_size.h"

#include <algorithm>
#include <cmath>

namespace pcl {
namespace kss {
namespace {

// fitted by evaluation/confidence/fit.py on cases made there; see docs/confidence.md
struct {
  double constant = 2.705, worst = 1.067, consistent = 2.083, residual = -1.268,
         score = 1.027;
} constexpr odds_of_pose;
struct {
  double constant = 0.001, best_consistent = 0.762, consistent = 2.102,
         residual = -0.701, score = 2.063, margin = 0.831;
} constexpr odds_of_best;

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

/** How near a surface counts as near, relative to an object in a scene, where the scene
 * shows enough of it to be asked. */
constexpr double blurred = 1.0 / 3.0;

/** What speaks for a pose. */
struct Witnesses {
  Support source, target;
  double score;
};

/** Both clouds, or the object alone where the other one is a scene, which owes it
 * nothing: neither its other things nor what hides the object speak against the pose.
 * The object's part of the score then counts twice. */
Witnesses
witnessesOf(const Alternative& alternative)
{
  const Evidence& evidence = alternative.evidence;
  const Overlap& overlap = alternative.overlap;
  if (!mayBeInScene(evidence.size) || evidence.reach > blurred)
    return {evidence.source, evidence.target, overlap.score};
  const bool is_source = evidence.size < 1.0;
  const Support& object = is_source ? evidence.source : evidence.target;
  const double own = is_source ? overlap.source : overlap.target;
  const double both = overlap.source + overlap.target;
  return {object, object, both > 0.0 ? overlap.score * 2.0 * own / both : 0.0};
}

/** The logarithm of a consistent share. */
double
logConsistent(const Support& support)
{
  return std::log(support.consistent + least_consistent);
}

} // namespace

double
logOddsOf(const Alternative& alternative)
{
  const auto [source, target, score] = witnessesOf(alternative);
  return odds_of_pose.constant +
         odds_of_pose.worst *
             std::log(std::max(source.worst, target.worst) + least_worst) +
         odds_of_pose.consistent * (logConsistent(source) + logConsistent(target)) /
             2.0 +
         odds_of_pose.residual *
             std::min(alternative.evidence.residual, most_residual) +
         odds_of_pose.score * score;
}

double
confidenceOf(const Alternatives& alternatives)
{
  if (alternatives.empty())
    return 0.0;
  const Alternative& best = alternatives[0];
  const double margin = alternatives.size() > 1
                            ? std::abs(logOddsOf(best) - logOddsOf(alternatives[1]))
                            : most_margin;
  const auto [source, target, score] = witnessesOf(best);
  const double of_source = logConsistent(source);
  const double of_target = logConsistent(target);
  // that scans share no more than a part does not count against the best pose
  const double odds =
      odds_of_best.constant +
      odds_of_best.best_consistent * std::max(of_source, of_target) +
      odds_of_best.consistent * (of_source + of_target) / 2.0 +
      odds_of_best.residual * std::min(best.evidence.residual, most_residual) +
      odds_of_best.score * score +
      odds_of_best.margin * std::log1p(std::min(margin, most_margin));
  // no more than so many witnesses can say: Laplace's rule of succession
  const double witnesses = std::min(source.points, target.points);
  return std::min(1.0 / (1.0 + std::exp(-odds)), (witnesses + 1.0) / (witnesses + 2.0));
}

bool
areEquallyGood(const Alternative& a, const Alternative& b)
{
  return std::abs(logOddsOf(a) - logOddsOf(b)) < equally_good;
}

bool
isAmbiguous(const Alternatives& alternatives)
{
  return alternatives.size() > 1 && areEquallyGood(alternatives[0], alternatives[1]) &&
         confidenceOf(alternatives) >= 0.5;
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
