/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "words.h"

#include "picture/short_text.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace tool {
namespace {

pcl::kss::Alternative
alternativeOf(const Pose& pose)
{
  return {pose.transformation, pose.overlap, pose.evidence};
}

/** What may help where the clouds show one object after all. */
std::string
adviceOnMisfit(const Result& result, const Options& options)
{
  const auto& settings = options.settings;
  std::string advice =
      "The best pose found is right with a probability of " +
      percent(result.confidence) + "; from " + percent(settings.minimum_confidence) +
      " on (--confidence) it would count. If the files do show one object, try ";
  if (settings.estimate_scale)
    advice += "--rigid where both are in one unit, ";
  if (settings.mode == pcl::kss::Mode::AUTOMATIC)
    advice += "--mode overlap where both lack parts, ";
  if (options.guess.empty())
    advice += "--guess FILE with about the right pose, ";
  return advice + "or look at what was found with --picture FILE.";
}

} // namespace

std::string
sureText(const Result& result)
{
  // no evidence is worth more
  const long hundredths = std::min(99l, std::lround(100.0 * result.confidence));
  return std::to_string(hundredths) + " % (of a hundred results as sure, " +
         std::to_string(hundredths) + (hundredths == 1 ? " is right" : " are right") +
         (result.ambiguous ? ", or as good as the right one)" : ")");
}

std::string
scaleText(const Result& result)
{
  std::ostringstream text;
  text << result.scale; // six digits
  return text.str();
}

std::size_t
numberOfRivals(const Result& result)
{
  if (!result.ambiguous)
    return 0;
  const auto first = alternativeOf(result.poses.front());
  return static_cast<std::size_t>(std::count_if(
      result.poses.begin() + 1, result.poses.end(),
      [&](const Pose& pose) { return areEquallyGood(first, alternativeOf(pose)); }));
}

std::string
ambiguityText(const Result& result)
{
  const std::size_t rivals = numberOfRivals(result);
  if (rivals == 0)
    return "";
  return (rivals == 1 ? "another pose fits"
                      : std::to_string(rivals) + " other poses fit") +
         std::string(" about as well, as with symmetric things: any of them may be the "
                     "right one; --guess FILE takes the one nearest to a guess");
}

std::string
scaleHint(const Result& result, const pcl::kss::Settings& settings)
{
  constexpr double CLOSE = 0.02, ROUNDING = 1e-9;
  const double off = std::abs(result.scale - 1.0);
  const bool may_be_one = off <= std::max(CLOSE, 2.0 * result.scale_deviation);
  const bool is_allowed =
      settings.smallest_scale <= 1.0 && settings.largest_scale >= 1.0;
  return settings.estimate_scale && is_allowed && may_be_one && off > ROUNDING
             ? "if both files are in one unit, say --rigid"
             : "";
}

std::string
whatToTry(const Result& result, const Options& options)
{
  switch (result.cause) {
  case pcl::kss::FailureCause::NO_FIT:
    return adviceOnMisfit(result, options);
  case pcl::kss::FailureCause::UNSETTLED:
    return "Try more --max-iterations, or --icp-points 0.";
  case pcl::kss::FailureCause::STOPPED:
    return "Try a longer --time-limit.";
  case pcl::kss::FailureCause::DEVICE:
    return "Try --device host, which needs no OpenCL.";
  default:
    return "";
  }
}

} // namespace tool
