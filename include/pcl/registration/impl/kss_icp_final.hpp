/*
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * The final ICP, on the clouds themselves: T of (e11), and the result among the poses
 * that compete for it.
 */

#pragma once

#include <pcl/console/print.h>
#include <pcl/registration/kss/detail/final_icp.h>
#include <pcl/registration/kss/detail/similarity.h>
#include <pcl/registration/kss_icp.h>

#include <algorithm>

namespace pcl {

template <typename PointSource, typename PointTarget, typename Scalar>
void
KSSICP<PointSource, PointTarget, Scalar>::rank(std::vector<Contender>& contenders)
{
  std::stable_sort(contenders.begin(), contenders.end(),
                   [](const Contender& a, const Contender& b) {
                     return a.alternative.overlap.score > b.alternative.overlap.score;
                   });
}

template <typename PointSource, typename PointTarget, typename Scalar>
std::string
KSSICP<PointSource, PointTarget, Scalar>::settle(
    const PointCloudSourceConstPtr& source,
    const kss::PoseScorer& scorer,
    const std::optional<Eigen::Matrix4d>& guess,
    std::vector<Contender>& contenders)
try {
  if (guess) {
    contenders.push_back({scorer.scored(*guess), {}});
    contenders.back() = finalICP(source, scorer, contenders.back().alternative);
  }
  rank(contenders);
  for (int runs = 0; runs < kss::most_final_icps && !contenders.front().run; ++runs) {
    // where nothing fits, one run is enough to say so
    if (runs > 0 && kss::confidenceOf(contenders.front().alternative.overlap) <
                        settings_.minimum_confidence)
      break;
    contenders.front() = finalICP(source, scorer, contenders.front().alternative);
    rank(contenders);
  }
  const auto best =
      std::find_if(contenders.begin(), contenders.end(),
                   [](const Contender& contender) { return contender.run != nullptr; });
  std::rotate(contenders.begin(), best, best + 1);
  return "";
}
catch (const kss::Stopped& stop) {
  rank(contenders); // and the best so far has to do
  return stop.what();
}

template <typename PointSource, typename PointTarget, typename Scalar>
typename KSSICP<PointSource, PointTarget, Scalar>::Contender
KSSICP<PointSource, PointTarget, Scalar>::finalICP(
    const PointCloudSourceConstPtr& source,
    const kss::PoseScorer& scorer,
    const Alternative& contender)
{
  const Eigen::Matrix4d& pose = contender.transformation;

  // ICP reads input_, all of it; it gets those points for so long
  struct Restore {
    KSSICP& icp;
    PointCloudSourceConstPtr input;
    double reach;
    ~Restore()
    {
      icp.input_ = input;
      icp.corr_dist_threshold_ = reach;
    }
  } restore{*this, input_, corr_dist_threshold_};
  input_ = source;
  // a point farther away than a few spacings has no counterpart
  if (settings_.mode != kss::Mode::GLOBAL_GLOBAL)
    corr_dist_threshold_ =
        std::min(corr_dist_threshold_, kss::final_icp_reach * scorer.spacingAt(pose));
  PointCloudSource unused;
  bool is_pose = true;
  try {
    Base::computeTransformation(unused, pose.cast<Scalar>());
    is_pose = kss::isSimilarity(final_transformation_.template cast<double>());
  }
  catch (const kss::NoPose&) {
    is_pose = false;
  }
  if (!is_pose)
    transformation_ = previous_transformation_ = Matrix4::Identity();
  Run run{final_transformation_, transformation_, previous_transformation_,
          nr_iterations_,        converged_,      *correspondences_};

  // an estimation can be singular, and nearest points lead astray where noise is heavy
  Alternative after = contender;
  if (is_pose)
    after = scorer.scored(final_transformation_.template cast<double>());
  if (!is_pose ||
      after.overlap.score < (1.0 - kss::final_icp_loss) * contender.overlap.score) {
    after = contender;
    run.transformation = pose.cast<Scalar>();
    run.converged = true;
  }
  return {after, std::make_shared<Run>(run)};
}

template <typename PointSource, typename PointTarget, typename Scalar>
void
KSSICP<PointSource, PointTarget, Scalar>::accept(const Contender& contender,
                                                 const Indices& source_indices)
{
  alternatives_.assign(1, contender.alternative);
  correspondences_->clear();
  if (!contender.run) {
    final_transformation_ =
        contender.alternative.transformation.template cast<Scalar>();
    return;
  }
  const Run& run = *contender.run;
  if (run.correspondences.size() < this->min_number_correspondences_)
    throw kss::RegistrationError(
        kss::FailureCause::UNSETTLED,
        "The final ICP found too few correspondences; allow longer ones, or reject "
        "fewer.");
  final_transformation_ = run.transformation;
  transformation_ = run.last_increment;
  previous_transformation_ = run.previous_increment;
  nr_iterations_ = run.iterations;
  converged_ = run.converged;
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
KSSICP<PointSource, PointTarget, Scalar>::judgeResult(const std::string& stopped)
{
  if (!stopped.empty())
    failure_ = {kss::FailureCause::STOPPED,
                stopped + "; the pose is the best one so far."};
  else if (!converged_)
    failure_ = {kss::FailureCause::UNSETTLED, "The final ICP still moved after " +
                                                  std::to_string(nr_iterations_) +
                                                  " iterations; allow more of them."};
  else if (getConfidence() < settings_.minimum_confidence)
    failure_ = {kss::FailureCause::NO_FIT, kss::misfitAt(getOverlap())};
  converged_ = failure_.cause == kss::FailureCause::NONE;
  if (!converged_)
    PCL_WARN("[pcl::%s] %s\n", getClassName().c_str(), failure_.reason.c_str());
}

} // namespace pcl
