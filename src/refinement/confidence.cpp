/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include <pcl/registration/kss/result.h>

#include <cmath>

namespace pcl {
namespace kss {
namespace {

/** The score in the middle between right poses and those of different objects, and how
 * fast the confidence rises there. */
constexpr double doubtful_score = 0.55;
constexpr double score_step = 0.05;

/** Poses whose scores differ by less than this share are about equally good: samplings
 * of one symmetric shape differ by less. */
constexpr double equally_good = 0.05;

/** The share of a complete cloud that another complete one covers at least. */
constexpr double complete = 0.9;

} // namespace

double
confidenceOf(const Overlap& overlap)
{
  return 1.0 / (1.0 + std::exp((doubtful_score - overlap.score) / score_step));
}

bool
isAmbiguous(const Alternatives& alternatives)
{
  return alternatives.size() > 1 && confidenceOf(alternatives[0].overlap) >= 0.5 &&
         alternatives[1].overlap.score >
             (1.0 - equally_good) * alternatives[0].overlap.score;
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
misfitAt(const Overlap& overlap)
{
  const auto percent = [](double share) {
    return std::to_string(std::lround(100.0 * share)) + " %";
  };
  return "The clouds do not fit: at the best pose " + percent(overlap.source) +
         " of the source and " + percent(overlap.target) +
         " of the target lie on the other cloud, too little or too loosely; do they "
         "show the same object?";
}

} // namespace kss
} // namespace pcl
