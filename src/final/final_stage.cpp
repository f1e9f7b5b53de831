/*
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * T of (e11), from each pose that may be right.
 */

#include <pcl/registration/kss/detail/final_stage.h>

#include <pcl/registration/kss/detail/similarity.h>
#include <pcl/registration/kss/detail/stopping.h>

#include "geometry/turns.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl {
namespace kss {
namespace {

/** Poses that may be right go through the final ICP, the likeliest first: those whose
 * overlap's score is at least this share of the best one. */
constexpr double hope = 0.75;

/** Where none of them has odds that good, as logarithm, no more are tried than are
 * likelier already: the clouds do not fit. */
constexpr double hopeless = -2.0;

/** And, unless the odds of one of them are ten to one, so many of the others. */
constexpr double doubtless = 2.3; // the logarithm
constexpr int most_final_icps = 3;

/** How far the logarithm of the scale may be from that of scale 1 for both to explain
 * the clouds: parts of known size come out up to a tenth off. */
constexpr double nearly_scale_one = 0.12;

/** Correspondences are no longer than so many spacings. */
constexpr double final_icp_reach = 4.0;

/** So many steps with few points, and with all of them before a pose is compared with
 * its rival: a right one takes a dozen, a wrong one, with nothing to settle on,
 * hundreds. */
constexpr int most_first_steps = 40;

/** Odds of a hundred to one, as logarithm, between two poses: what the worse one may
 * still gain changes the confidence in the better one by a hundredth at most. */
constexpr double no_rival = 4.6;

/** A pose that its rival is ahead of by more than chance when it has made those steps
 * with all points is left: right poses are at rest by then. */
constexpr double left_behind = 0.0;

/** Steps of a run, about: what progress goes by. */
constexpr double usual_steps = 10.0;

/** Poses whose scores are that near, as a ratio, may be equal: of two samplings of a
 * symmetric shape. */
constexpr double same_score = 0.97;

/** The share of the score that a pose may lose to the final ICP: what chance causes. */
constexpr double final_icp_loss = 0.01;

constexpr double infinite = std::numeric_limits<double>::infinity();

/** Whether the surfaces speak more for it; who has had no run comes last. */
bool
isMoreLikely(const FinalContender& a, const FinalContender& b)
{
  if (static_cast<bool>(a.run) != static_cast<bool>(b.run))
    return static_cast<bool>(a.run);
  return logOddsOf(a.alternative) > logOddsOf(b.alternative);
}

} // namespace

FinalRun::~FinalRun() = default;

FinalICP::~FinalICP() = default;

FinalStage::FinalStage(const Settings& settings,
                       const PoseScorer& scorer,
                       const FinalClouds& clouds,
                       FinalICP& icp,
                       const Stages& stages)
: settings_(settings)
, scorer_(scorer)
, clouds_(clouds)
, icp_(icp)
, stages_(stages)
{
}

std::vector<FinalContender>
FinalStage::settle(const Alternatives& alternatives,
                   const std::optional<StoredPose>& guess)
{
  std::vector<FinalContender> contenders;
  for (const Alternative& alternative : alternatives)
    contenders.push_back({alternative});
  try {
    if (guess) {
      const StoredPose upright =
          turnedAbout(settings_.rotation_axis, *guess, clouds_.source_centroid);
      contenders.insert(contenders.begin(), {scorer_.scored(upright), {}, true});
    }
    runAll(contenders);
    std::stable_sort(contenders.begin(), contenders.end(), isMoreLikely);
    contenders.front() = onSkinBeside(contenders.front());
    preferNearest(guess.value_or(StoredPose::Identity()), contenders);
    if (settings_.estimate_scale)
      contenders.front() = atScaleOne(contenders.front());
  }
  catch (const Stopped& stop) {
    // and the best so far has to do
    std::stable_sort(contenders.begin(), contenders.end(), isMoreLikely);
    stopped_ = stop.what();
  }
  // later on, an estimation that is none can have led away from all
  const FinalRun* const run = contenders.front().run.get();
  if (run && run->iterations == 0 && run->has_too_few_pairs)
    throw RegistrationError(
        FailureCause::UNSETTLED,
        "The final ICP found too few correspondences; allow longer ones, or reject "
        "fewer.");
  return contenders;
}

FinalRun
FinalStage::stepFrom(const StoredPose& pose)
{
  FinalStepSettings settings;
  settings.surfaces = surfaceStepSettings(false, false);
  settings.reach = final_icp_reach * scorer_.spacingAt(pose);
  settings.goes_on = false;
  settings.made = [](int) {};
  StoredPose moved = pose;
  int made = 0;
  const bool is_pose = icp_.iterate({true, 1, infinite}, settings, moved, made);
  return *icp_.lastRun(is_pose && made > 0);
}

void
FinalStage::runAll(std::vector<FinalContender>& contenders)
{
  int runs = 0;
  const Alternative* rival = nullptr;
  double best = -infinite, closest = 0.0;
  for (FinalContender& contender : contenders) {
    const double score = contender.alternative.overlap.score;
    const bool may_be_right = score >= hope * closest && best > hopeless;
    const bool is_doubtful =
        best > hopeless && best < doubtless && runs < most_final_icps;
    const bool is_likelier = logOddsOf(contender.alternative) > best;
    if (runs > 0 && !may_be_right && !is_doubtful && !is_likelier)
      break;
    const bool is_guess = contender.is_guess;
    contender = run(steps(), contender.alternative, !is_guess, rival);
    contender.is_guess = is_guess;
    ++runs;
    if (const double odds = logOddsOf(contender.alternative); odds > best) {
      best = odds;
      rival = &contender.alternative;
    }
    closest = std::max(closest, contender.alternative.overlap.score);
  }
}

std::vector<FinalStep>
FinalStage::steps() const
{
  int left = clouds_.iterations;
  std::vector<FinalStep> steps;
  if (clouds_.points > 2 * points_of_first_steps)
    steps.push_back({false, std::min(most_first_steps, left), no_rival});
  if (left >= 2 * most_first_steps) {
    steps.push_back({true, most_first_steps, left_behind});
    left -= most_first_steps;
  }
  steps.push_back({true, left, infinite});
  return steps;
}

FinalStep
FinalStage::whole() const
{
  return {true, clouds_.iterations, infinite};
}

FinalContender
FinalStage::run(const std::vector<FinalStep>& steps,
                const Alternative& contender,
                bool estimate_scale,
                const Alternative* rival,
                bool has_skins)
{
  ++runs_;
  FinalStepSettings settings;
  settings.surfaces = surfaceStepSettings(estimate_scale, has_skins);
  StoredPose pose = contender.transformation;
  bool is_pose = true;
  int iterations = 0; // with all points
  for (const FinalStep& step : steps) {
    // a point farther away than a few spacings has no counterpart
    settings.reach = settings_.mode != Mode::GLOBAL_GLOBAL
                         ? final_icp_reach * scorer_.spacingAt(pose)
                         : infinite;
    settings.goes_on = iterations > 0;
    // how many runs, and steps, there will be shows in the end
    settings.made = [this, before = iterations](int made_now) {
      const int made = before + made_now;
      const double done = runs_ - 1 + made / (made + usual_steps);
      stages_.progress(done / (done + 1.0));
    };
    int made = 0;
    is_pose = icp_.iterate(step, settings, pose, made);
    if (!is_pose) {
      iterations = std::max(1, iterations + made);
      break;
    }
    if (step.has_all_points) {
      iterations += made;
      if (made < step.iterations)
        break;
    }
    if (!rival || std::isinf(step.most_behind))
      continue;
    Alternative so_far = scorer_.scored(pose);
    if (logOddsOf(so_far) < logOddsOf(contender))
      so_far = contender;
    if (logOddsOf(so_far) < logOddsOf(*rival) - step.most_behind &&
        !areEquallyGood(so_far, *rival))
      return {so_far};
  }
  const std::shared_ptr<FinalRun> run = icp_.lastRun(is_pose);
  run->iterations = iterations;

  // an estimation can be singular, and nearest points lead astray where noise is heavy;
  // where samplings are regular, the right pose lays points between points
  Alternative after;
  if (is_pose)
    after = scorer_.scored(pose);
  const bool loses_overlap =
      after.overlap.score < (1.0 - final_icp_loss) * contender.overlap.score;
  if (!is_pose || (loses_overlap && logOddsOf(after) < logOddsOf(contender))) {
    after = contender;
    run->transformation = contender.transformation;
    run->converged = true;
    run->precision = {};
  }
  return {after, run};
}

SurfaceStepSettings
FinalStage::surfaceStepSettings(bool estimate_scale, bool has_skins) const
{
  SurfaceStepSettings settings;
  // one value: it is known, and the pose has it
  const bool is_known = settings_.smallest_scale >= settings_.largest_scale;
  if (estimate_scale && settings_.estimate_scale && !is_known) {
    settings.smallest_scale = settings_.smallest_scale;
    settings.largest_scale = settings_.largest_scale;
  }
  settings.rotation_axis = settings_.rotation_axis;
  settings.rounding_error = clouds_.rounding_error;
  settings.has_skins = has_skins;
  settings.source_normal_error = scorer_.sourceNormalError();
  settings.target_normal_error = scorer_.targetNormalError();
  return settings;
}

FinalContender
FinalStage::onSkinBeside(const FinalContender& contender)
{
  const auto beside = scorer_.skinBeside(contender.alternative.transformation);
  if (!beside)
    return contender;
  FinalContender settled =
      run({whole()}, scorer_.scored(*beside), !contender.is_guess, nullptr, true);
  settled.is_guess = contender.is_guess;
  return isMoreLikely(settled, contender) ? settled : contender;
}

FinalContender
FinalStage::atScaleOne(const FinalContender& contender)
{
  const StoredPose& pose = contender.alternative.transformation;
  const double scale = scaleOf(pose);
  const bool may_be_one =
      settings_.smallest_scale <= 1.0 && settings_.largest_scale >= 1.0;
  if (contender.is_guess || !may_be_one || std::abs(std::log(scale)) > nearly_scale_one)
    return contender;
  // about the middle of the source
  StoredPose metric = pose;
  metric.topLeftCorner<3, 3>() /= scale;
  metric.topRightCorner<3, 1>() +=
      (pose - metric).topLeftCorner<3, 3>() * clouds_.source_centroid;
  const FinalContender settled = run({whole()}, scorer_.scored(metric), false);
  // what is as good only where the scale found is 1 as far as it is known
  const bool is_one = std::log(scale) * std::log(scale) <=
                      9.0 * contender.run->precision.covariance(6, 6);
  return isMoreLikely(settled, contender) ||
                 (is_one && areEquallyGood(settled.alternative, contender.alternative))
             ? settled
             : contender;
}

void
FinalStage::preferNearest(const StoredPose& guess,
                          std::vector<FinalContender>& contenders) const
{
  const Alternative best = contenders.front().alternative;
  const auto distance = [&](const FinalContender& contender) {
    return scorer_.distance(contender.alternative.transformation, guess);
  };
  auto nearest = contenders.begin();
  for (auto other = contenders.begin() + 1; other != contenders.end(); ++other)
    if (other->run && areEquallyGood(best, other->alternative) &&
        other->alternative.overlap.score >= same_score * best.overlap.score &&
        distance(*other) < distance(*nearest))
      nearest = other;
  std::rotate(contenders.begin(), nearest, nearest + 1);
}

Alternatives
distinctPoses(const std::vector<FinalContender>& contenders, const PoseScorer& scorer)
{
  Alternatives distinct;
  for (const FinalContender& contender : contenders)
    if (std::none_of(distinct.begin(), distinct.end(), [&](const Alternative& listed) {
          return scorer.areSame(listed.transformation,
                                contender.alternative.transformation);
        }))
      distinct.push_back(contender.alternative);
  return distinct;
}

Failure
failureOf(const Settings& settings,
          const Alternatives& alternatives,
          const FinalRun* run,
          const std::string& stopped,
          const std::function<std::string()>& whatWouldFit)
{
  if (!stopped.empty())
    return {FailureCause::STOPPED, stopped + "; the pose is the best one so far."};
  if (!run || !run->converged) {
    const int iterations = run ? run->iterations : 0;
    return {FailureCause::UNSETTLED,
            "The final ICP still moved after " + std::to_string(iterations) +
                (iterations == 1 ? " iteration" : " iterations") +
                "; allow more of them."};
  }
  if (confidenceOf(alternatives) >= settings.minimum_confidence)
    return {};
  const std::string known = whatWouldFit ? whatWouldFit() : "";
  return {FailureCause::NO_FIT,
          known.empty() ? misfitAt(alternatives.front().evidence) : known};
}

} // namespace kss
} // namespace pcl
