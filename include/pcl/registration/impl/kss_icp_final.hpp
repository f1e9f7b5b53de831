/*
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * The final ICP, on the clouds themselves: T of (e11), and the result among the poses
 * that compete for it.
 */

#pragma once

#include <pcl/common/centroid.h>
#include <pcl/console/print.h>
#include <pcl/registration/kss/detail/final_icp.h>
#include <pcl/registration/kss/detail/similarity.h>
#include <pcl/registration/kss/detail/surface_estimation.h>
#include <pcl/registration/kss_icp.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl {

template <typename PointSource, typename PointTarget, typename Scalar>
typename KSSICP<PointSource, PointTarget, Scalar>::FinalSteps
KSSICP<PointSource, PointTarget, Scalar>::finalSteps(const Indices& used) const
{
  constexpr double infinite = std::numeric_limits<double>::infinity();
  constexpr int first = kss::most_first_steps;
  int left = this->max_iterations_;
  FinalSteps steps;
  if (used.size() > 2 * kss::points_of_first_steps)
    steps.push_back(
        {kss::pointsAt(*input_, kss::spread(used, kss::points_of_first_steps)),
         std::min(first, left), kss::no_rival});
  const PointCloudSourceConstPtr all = kss::pointsAt(*input_, used);
  if (left >= 2 * first) {
    steps.push_back({all, first, kss::left_behind});
    left -= first;
  }
  steps.push_back({all, left, infinite});
  return steps;
}

template <typename PointSource, typename PointTarget, typename Scalar>
std::string
KSSICP<PointSource, PointTarget, Scalar>::settle(
    const FinalSteps& steps,
    const kss::PoseScorer& scorer,
    const std::optional<Eigen::Matrix4d>& guess,
    std::vector<Contender>& contenders)
try {
  if (guess)
    contenders.insert(contenders.begin(), {scorer.scored(*guess), {}, true});
  int runs = 0;
  const Alternative* rival = nullptr;
  double best = -std::numeric_limits<double>::infinity(), closest = 0.0;
  for (Contender& contender : contenders) {
    const double score = contender.alternative.overlap.score;
    const bool may_be_right = score >= kss::hope * closest && best > kss::hopeless;
    const bool is_doubtful =
        best > kss::hopeless && best < kss::doubtless && runs < kss::most_final_icps;
    const bool is_likelier = kss::logOddsOf(contender.alternative) > best;
    if (runs > 0 && !may_be_right && !is_doubtful && !is_likelier)
      break;
    const bool is_guess = contender.is_guess;
    contender = finalICP(steps, scorer, contender.alternative, !is_guess, rival);
    contender.is_guess = is_guess;
    ++runs;
    if (const double odds = kss::logOddsOf(contender.alternative); odds > best) {
      best = odds;
      rival = &contender.alternative;
    }
    closest = std::max(closest, contender.alternative.overlap.score);
  }
  std::stable_sort(contenders.begin(), contenders.end(), isMoreLikely);
  const FinalStep whole{steps.back().points, this->max_iterations_,
                        steps.back().most_behind};
  contenders.front() = onSkinBeside(whole, scorer, contenders.front());
  preferNearest(guess.value_or(Eigen::Matrix4d::Identity()), scorer, contenders);
  if (settings_.estimate_scale)
    contenders.front() = atScaleOne(whole, scorer, contenders.front());
  return "";
}
catch (const kss::Stopped& stop) {
  // and the best so far has to do
  std::stable_sort(contenders.begin(), contenders.end(), isMoreLikely);
  return stop.what();
}

template <typename PointSource, typename PointTarget, typename Scalar>
bool
KSSICP<PointSource, PointTarget, Scalar>::isMoreLikely(const Contender& a,
                                                       const Contender& b)
{
  if (static_cast<bool>(a.run) != static_cast<bool>(b.run))
    return static_cast<bool>(a.run);
  return kss::logOddsOf(a.alternative) > kss::logOddsOf(b.alternative);
}

template <typename PointSource, typename PointTarget, typename Scalar>
void
KSSICP<PointSource, PointTarget, Scalar>::preferNearest(
    const Eigen::Matrix4d& guess,
    const kss::PoseScorer& scorer,
    std::vector<Contender>& contenders)
{
  const Alternative best = contenders.front().alternative;
  const auto distance = [&](const Contender& contender) {
    return scorer.distance(contender.alternative.transformation, guess);
  };
  auto nearest = contenders.begin();
  for (auto other = contenders.begin() + 1; other != contenders.end(); ++other)
    if (other->run && kss::areEquallyGood(best, other->alternative) &&
        other->alternative.overlap.score >= kss::same_score * best.overlap.score &&
        distance(*other) < distance(*nearest))
      nearest = other;
  std::rotate(contenders.begin(), nearest, nearest + 1);
}

template <typename PointSource, typename PointTarget, typename Scalar>
typename KSSICP<PointSource, PointTarget, Scalar>::Contender
KSSICP<PointSource, PointTarget, Scalar>::onSkinBeside(const FinalStep& step,
                                                       const kss::PoseScorer& scorer,
                                                       const Contender& contender)
{
  const auto beside = scorer.skinBeside(contender.alternative.transformation);
  if (!beside)
    return contender;
  Contender settled = finalICP({step}, scorer, scorer.scored(*beside),
                               !contender.is_guess, nullptr, true);
  settled.is_guess = contender.is_guess;
  return isMoreLikely(settled, contender) ? settled : contender;
}

template <typename PointSource, typename PointTarget, typename Scalar>
typename KSSICP<PointSource, PointTarget, Scalar>::Contender
KSSICP<PointSource, PointTarget, Scalar>::atScaleOne(const FinalStep& step,
                                                     const kss::PoseScorer& scorer,
                                                     const Contender& contender)
{
  const Eigen::Matrix4d& pose = contender.alternative.transformation;
  const double scale = kss::scaleOf(pose);
  const bool may_be_one =
      settings_.smallest_scale <= 1.0 && settings_.largest_scale >= 1.0;
  if (contender.is_guess || !may_be_one ||
      std::abs(std::log(scale)) > kss::nearly_scale_one)
    return contender;
  Eigen::Matrix4d metric = pose;
  metric.topLeftCorner<3, 3>() /= scale;
  Eigen::Vector4d center;
  compute3DCentroid(*step.points, center);
  metric.topRightCorner<3, 1>() +=
      (pose - metric).topLeftCorner<3, 3>() * center.head<3>();
  const Contender settled = finalICP({step}, scorer, scorer.scored(metric), false);
  // what is as good only where the scale found is 1 as far as it is known
  const bool is_one = std::log(scale) * std::log(scale) <=
                      9.0 * contender.run->precision.covariance(6, 6);
  return isMoreLikely(settled, contender) ||
                 (is_one &&
                  kss::areEquallyGood(settled.alternative, contender.alternative))
             ? settled
             : contender;
}

template <typename PointSource, typename PointTarget, typename Scalar>
typename KSSICP<PointSource, PointTarget, Scalar>::Contender
KSSICP<PointSource, PointTarget, Scalar>::finalICP(const FinalSteps& steps,
                                                   const kss::PoseScorer& scorer,
                                                   const Alternative& contender,
                                                   bool estimate_scale,
                                                   const Alternative* rival,
                                                   bool has_skins)
{
  ++final_runs_;
  const kss::SurfaceStepSettings settings =
      surfaceStepSettings(scorer, estimate_scale, has_skins);
  Eigen::Matrix4d pose = contender.transformation;
  bool is_pose = true;
  int iterations = 0; // with all points
  for (const FinalStep& step : steps) {
    is_pose = runICP(step, iterations, scorer, settings, pose);
    if (!is_pose) {
      iterations = std::max(1, iterations + nr_iterations_);
      break;
    }
    const bool are_all = step.points == steps.back().points;
    if (are_all)
      iterations += nr_iterations_;
    if (are_all && nr_iterations_ < step.iterations)
      break;
    if (!rival || std::isinf(step.most_behind))
      continue;
    Alternative so_far = scorer.scored(pose);
    if (kss::logOddsOf(so_far) < kss::logOddsOf(contender))
      so_far = contender;
    if (kss::logOddsOf(so_far) < kss::logOddsOf(*rival) - step.most_behind &&
        !kss::areEquallyGood(so_far, *rival))
      return {so_far, {}};
  }
  if (!is_pose)
    transformation_ = previous_transformation_ = Matrix4::Identity();
  Run run = lastRun();
  run.iterations = iterations;
  if (is_pose) {
    if (const auto* surfaces =
            dynamic_cast<kss::SurfaceEstimation<PointSource, PointTarget, Scalar>*>(
                this->transformation_estimation_.get()))
      run.precision = surfaces->precision(
          (pose * source_centroid_.homogeneous()).template head<3>());
  }

  // an estimation can be singular, and nearest points lead astray where noise is heavy;
  // where samplings are regular, the right pose lays points between points
  Alternative after;
  if (is_pose)
    after = scorer.scored(pose);
  const bool loses_overlap =
      after.overlap.score < (1.0 - kss::final_icp_loss) * contender.overlap.score;
  if (!is_pose ||
      (loses_overlap && kss::logOddsOf(after) < kss::logOddsOf(contender))) {
    after = contender;
    run.transformation = contender.transformation.template cast<Scalar>();
    run.converged = true;
    run.precision = {};
    if (!is_pose)
      run.correspondences.clear();
  }
  return {after, std::make_shared<Run>(run)};
}

template <typename PointSource, typename PointTarget, typename Scalar>
bool
KSSICP<PointSource, PointTarget, Scalar>::runICP(
    const FinalStep& step,
    int before,
    const kss::PoseScorer& scorer,
    const kss::SurfaceStepSettings& settings,
    Eigen::Matrix4d& pose)
{
  // ICP reads input_, all of it; it gets those points for so long
  struct Restore {
    KSSICP& icp;
    PointCloudSourceConstPtr input;
    double reach;
    int iterations;
    ~Restore()
    {
      icp.input_ = input;
      icp.corr_dist_threshold_ = reach;
      icp.max_iterations_ = iterations;
    }
  } restore{*this, input_, corr_dist_threshold_, this->max_iterations_};
  input_ = step.points;
  this->max_iterations_ = step.iterations;
  // a point farther away than a few spacings has no counterpart
  if (settings_.mode != kss::Mode::GLOBAL_GLOBAL)
    corr_dist_threshold_ =
        std::min(corr_dist_threshold_, kss::final_icp_reach * scorer.spacingAt(pose));
  auto* const surfaces =
      dynamic_cast<kss::SurfaceEstimation<PointSource, PointTarget, Scalar>*>(
          this->transformation_estimation_.get());
  if (surfaces)
    surfaces->start(scorer, step.points, target_->size(), pose, settings, before > 0);
  if (auto* const criteria =
          dynamic_cast<kss::FinalICPCriteria<Scalar>*>(convergence_criteria_.get())) {
    criteria->follow(surfaces ? &surfaces->last() : nullptr);
    // how many runs, and steps, there will be shows in the end
    criteria->tell([this, before](int iterations) {
      const int made = before + iterations;
      const double done = final_runs_ - 1 + made / (made + kss::usual_steps);
      stages_.progress(done / (done + 1.0));
    });
  }
  PointCloudSource unused;
  try {
    Base::computeTransformation(unused, pose.cast<Scalar>());
  }
  catch (const kss::NoPose&) {
    return false;
  }
  pose = final_transformation_.template cast<double>();
  return kss::isSimilarity(pose);
}

template <typename PointSource, typename PointTarget, typename Scalar>
kss::SurfaceStepSettings
KSSICP<PointSource, PointTarget, Scalar>::surfaceStepSettings(
    const kss::PoseScorer& scorer, bool estimate_scale, bool has_skins) const
{
  kss::SurfaceStepSettings settings;
  // one value: it is known, and the pose has it
  const bool is_known = settings_.smallest_scale >= settings_.largest_scale;
  if (estimate_scale && settings_.estimate_scale && !is_known) {
    settings.smallest_scale = settings_.smallest_scale;
    settings.largest_scale = settings_.largest_scale;
  }
  settings.rounding_error = rounding_error_;
  settings.has_skins = has_skins;
  settings.source_normal_error = scorer.sourceNormalError();
  settings.target_normal_error = scorer.targetNormalError();
  return settings;
}

template <typename PointSource, typename PointTarget, typename Scalar>
typename KSSICP<PointSource, PointTarget, Scalar>::Run
KSSICP<PointSource, PointTarget, Scalar>::lastRun() const
{
  return {final_transformation_,
          transformation_,
          previous_transformation_,
          nr_iterations_,
          converged_,
          *correspondences_,
          {}};
}

template <typename PointSource, typename PointTarget, typename Scalar>
void
KSSICP<PointSource, PointTarget, Scalar>::accept(const Contender& contender,
                                                 const Indices& source_indices)
{
  alternatives_.assign(1, contender.alternative);
  precision_ = {};
  correspondences_->clear();
  if (!contender.run) {
    final_transformation_ =
        contender.alternative.transformation.template cast<Scalar>();
    return;
  }
  const Run& run = *contender.run;
  // later on, an estimation that is none can have led away from all
  if (run.iterations == 0 &&
      run.correspondences.size() <
          static_cast<std::size_t>(this->min_number_correspondences_))
    throw kss::RegistrationError(
        kss::FailureCause::UNSETTLED,
        "The final ICP found too few correspondences; allow longer ones, or reject "
        "fewer.");
  final_transformation_ = run.transformation;
  transformation_ = run.last_increment;
  previous_transformation_ = run.previous_increment;
  nr_iterations_ = run.iterations;
  converged_ = run.converged;
  precision_ = run.precision;
  *correspondences_ = run.correspondences;
  for (Correspondence& correspondence : *correspondences_)
    correspondence.index_query = source_indices[correspondence.index_query];
}

template <typename PointSource, typename PointTarget, typename Scalar>
void
KSSICP<PointSource, PointTarget, Scalar>::list(const std::vector<Contender>& contenders,
                                               const kss::PoseScorer& scorer)
{
  for (const Contender& contender : contenders)
    if (std::none_of(alternatives_.begin(), alternatives_.end(),
                     [&](const Alternative& listed) {
                       return scorer.areSame(listed.transformation,
                                             contender.alternative.transformation);
                     }))
      alternatives_.push_back(contender.alternative);
}

template <typename PointSource, typename PointTarget, typename Scalar>
void
KSSICP<PointSource, PointTarget, Scalar>::judgeResult(const std::string& stopped,
                                                      double given_scale)
{
  if (!stopped.empty())
    failure_ = {kss::FailureCause::STOPPED,
                stopped + "; the pose is the best one so far."};
  else if (!converged_)
    failure_ = {kss::FailureCause::UNSETTLED, "The final ICP still moved after " +
                                                  std::to_string(nr_iterations_) +
                                                  " iterations; allow more of them."};
  else if (getConfidence() < settings_.minimum_confidence) {
    const std::string known = explains_misfits_ ? whatWouldFit(given_scale) : "";
    failure_ = {kss::FailureCause::NO_FIT,
                known.empty() ? kss::misfitAt(getEvidence()) : known};
  }
  converged_ = failure_.cause == kss::FailureCause::NONE;
  if (!converged_ && explains_misfits_)
    PCL_WARN("[pcl::%s] %s\n", getClassName().c_str(), failure_.reason.c_str());
}

} // namespace pcl
