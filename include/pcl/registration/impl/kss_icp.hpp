/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/console/print.h>
#include <pcl/registration/kss/detail/cloud_conversion.h>
#include <pcl/registration/kss/detail/copies.h>
#include <pcl/registration/kss/detail/final_icp.h>
#include <pcl/registration/kss/detail/final_stage.h>
#include <pcl/registration/kss/detail/misfit.h>
#include <pcl/registration/kss/detail/naming.h>
#include <pcl/registration/kss/detail/packed_search.h>
#include <pcl/registration/kss/detail/similarity.h>
#include <pcl/registration/kss/detail/surface_estimation.h>
#include <pcl/registration/kss/detail/tracked_correspondences.h>
#include <pcl/registration/kss/detail/warnings.h>
#include <pcl/registration/kss_icp.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace pcl {

template <typename PointSource, typename PointTarget, typename Scalar>
KSSICP<PointSource, PointTarget, Scalar>::KSSICP()
{
  reg_name_ = "KSSICP";
  kss::showWarningsByPCL();
  this->max_iterations_ = 300;
  this->euclidean_fitness_epsilon_ = 1e-5;
  convergence_criteria_.reset(new kss::FinalICPCriteria<Scalar>(
      nr_iterations_, transformation_, *correspondences_));
  convergence_criteria_->setAbsoluteMSE(0.0);
  convergence_criteria_->setFailureAfterMaximumIterations(true);
  correspondence_estimation_.reset(
      new kss::TrackedCorrespondences<PointSource, PointTarget, Scalar>);
  this->tree_.reset(new kss::PackedSearch<PointTarget>);
  this->transformation_estimation_.reset(
      new kss::SurfaceEstimation<PointSource, PointTarget, Scalar>);
}

template <typename PointSource, typename PointTarget, typename Scalar>
void
KSSICP<PointSource, PointTarget, Scalar>::setInputSource(
    const PointCloudSourceConstPtr& cloud)
{
  source_is_output_ = false;
  if (cloud && !cloud->empty()) {
    Base::setInputSource(cloud);
    return;
  }
  input_.reset();
  giveUp(Matrix4::Identity(), {kss::FailureCause::INPUT,
                               "The source cloud is empty; set one that has points."});
}

template <typename PointSource, typename PointTarget, typename Scalar>
void
KSSICP<PointSource, PointTarget, Scalar>::setInputTarget(
    const PointCloudTargetConstPtr& cloud)
{
  // the same cloud may hold other points than before
  if (auto* tracked =
          dynamic_cast<kss::TrackedCorrespondences<PointSource, PointTarget, Scalar>*>(
              correspondence_estimation_.get()))
    tracked->reset();
  if (cloud && !cloud->empty()) {
    Base::setInputTarget(cloud);
    return;
  }
  target_.reset();
  giveUp(Matrix4::Identity(), {kss::FailureCause::INPUT,
                               "The target cloud is empty; set one that has points."});
}

template <typename PointSource, typename PointTarget, typename Scalar>
void
KSSICP<PointSource, PointTarget, Scalar>::align(PointCloudSource& output)
{
  align(output, Matrix4::Identity());
}

template <typename PointSource, typename PointTarget, typename Scalar>
void
KSSICP<PointSource, PointTarget, Scalar>::align(PointCloudSource& output,
                                                const Matrix4& guess)
{
  stop_.restart(settings_.time_limit);
  const kss::HeedingSignal heeding(&stop_);
  const PointCloudSourceConstPtr source = input_;
  const bool in_place = source.get() == &output;
  try {
    // An output that is the source itself must not change it before it has been read.
    if (in_place)
      input_ = pcl::make_shared<PointCloudSource>(*source);
    throwOnBadInput();
    Base::align(output, guess);
  }
  catch (...) {
    giveUp(guess, kss::failureOfException());
    copyIndexedSource(output);
    place(output, output, final_transformation_);
  }
  input_ = source;
  source_is_output_ = in_place;
}

template <typename PointSource, typename PointTarget, typename Scalar>
void
KSSICP<PointSource, PointTarget, Scalar>::throwOnBadInput() const
{
  if (!input_)
    throw std::invalid_argument("There is no source cloud; set one that has points.");
  if (!target_)
    throw std::invalid_argument("There is no target cloud; set one that has points.");
  if (!kss::canBeSearched(*target_))
    throw std::invalid_argument("The target cloud has points more than 1e38 from the "
                                "origin, too far for PCL's tree; leave them out.");
  if (indices_ && !this->fake_indices_)
    for (const index_t index : *indices_)
      if (index < 0 || static_cast<std::size_t>(index) >= input_->size())
        throw std::invalid_argument("The index " + std::to_string(index) +
                                    " is out of range: the source has " +
                                    std::to_string(input_->size()) + " points.");
}

template <typename PointSource, typename PointTarget, typename Scalar>
void
KSSICP<PointSource, PointTarget, Scalar>::copyIndexedSource(
    PointCloudSource& output) const
{
  output.clear();
  if (!input_)
    return;
  if (!indices_ || this->fake_indices_) {
    output = *input_;
    return;
  }
  output.header = input_->header;
  output.is_dense = input_->is_dense;
  for (const index_t index : *indices_)
    if (index >= 0 && static_cast<std::size_t>(index) < input_->size())
      output.push_back((*input_)[index]);
}

template <typename PointSource, typename PointTarget, typename Scalar>
void
KSSICP<PointSource, PointTarget, Scalar>::computeTransformation(
    PointCloudSource& output, const Matrix4& guess)
{
  if (kss::heededSignal() != &stop_) // called by PCL's own align()
    stop_.restart(settings_.time_limit);
  const kss::HeedingSignal heeding(&stop_);
  try {
    registerClouds(guess);
  }
  catch (...) {
    giveUp(guess, kss::failureOfException());
    alignment_.reset(); // whatever it was in the midst of
  }
  // align() has filled the output with the (indexed) source
  place(output, output, final_transformation_);
}

template <typename PointSource, typename PointTarget, typename Scalar>
void
KSSICP<PointSource, PointTarget, Scalar>::registerClouds(const Matrix4& guess)
{
  failure_ = {};
  stages_.restart(settings_.progress);
  std::optional<kss::StoredPose> guessed;
  if (guess != Matrix4::Identity())
    guessed = guess.template cast<double>();
  const auto [source_points, target_points] = usablePoints(guessed);
  far_points_ = {source_points.far, target_points.far};

  // a handful of points has no surface, but may be a copy
  if (source_points.indices.size() <= kss::most_points_of_copies) {
    const kss::Alternatives copies =
        kss::copiesOf(kss::toLocalCloud(*input_, source_points),
                      kss::toLocalCloud(*target_, target_points), settings_, guessed);
    if (!copies.empty()) {
      acceptCopies(copies);
      return;
    }
  }

  // simplification, pre-shapes, {C} x {O}, energies, minima, ICP on each
  kss::Alignment& alignment = alignmentForSettings();
  std::optional<double> guessed_scale;
  if (guessed)
    guessed_scale = kss::scaleOf(*guessed);
  const kss::Aligned aligned = alignment.align(
      kss::toLocalCloud(*input_, source_points),
      kss::toLocalCloud(*target_, target_points), guessed_scale, stages_);
  device_name_ = alignment.deviceName();

  // ICP on the clouds themselves, (e11), and the choice among the poses
  stages_.begin("final ICP");
  const double given_scale = guessed_scale.value_or(1.0);
  const kss::PoseScorer& scorer = aligned.scorer;
  const double squared_rounding_error =
      kss::roundingError(kss::placesOf(*target_), target_points.indices);
  Indices used = kss::spread(source_points.indices, settings_.icp_points);
  kss::sortInSpace(kss::placesOf(*input_), used);
  kss::FinalClouds clouds;
  clouds.points = used.size();
  clouds.iterations = std::max(1, this->max_iterations_);
  clouds.rounding_error = std::sqrt(squared_rounding_error);
  clouds.source_centroid =
      kss::centroidOf(kss::placesOf(*input_), source_points.indices);
  std::vector<kss::FinalContender> contenders;
  std::string stopped;
  {
    FinalICP icp(*this, scorer, used, clouds.source_centroid, squared_rounding_error);
    kss::FinalStage final_stage(settings_, scorer, clouds, icp, stages_);
    contenders = final_stage.settle(aligned.alternatives, guessed);
    stopped = final_stage.stopped();
  }
  accept(contenders.front(), used);
  alternatives_ = kss::distinctPoses(contenders, scorer);
  stages_.end();

  const double size_ratio = target_points.bulk.radius / source_points.bulk.radius;
  failure_ = kss::failureOf(
      settings_, alternatives_, contenders.front().run.get(), stopped, [&] {
        if (!explains_misfits_)
          return std::string();
        return kss::whatWouldFit(
            settings_, getOverlap(), given_scale, size_ratio,
            [&](kss::Mirror mirror, const kss::Settings& settings) {
              return scaleOfFit(mirror, given_scale, settings);
            });
      });
  converged_ = failure_.cause == kss::FailureCause::NONE;
  if (!converged_ && explains_misfits_)
    PCL_WARN("[pcl::%s] %s\n", getClassName().c_str(), failure_.reason.c_str());
}

template <typename PointSource, typename PointTarget, typename Scalar>
std::pair<kss::UsablePoints<index_t>, kss::UsablePoints<index_t>>
KSSICP<PointSource, PointTarget, Scalar>::usablePoints(
    const std::optional<kss::StoredPose>& guess) const
{
  if (guess && !kss::isSimilarity(*guess))
    throw std::invalid_argument(
        "The guess is not a rotation, translation and positive scale.");
  const auto source =
      kss::naming("source", [&] { return kss::usablePointsOf(*input_, *indices_); });
  const auto target = kss::naming("target", [&] {
    return kss::usablePointsOf(*target_, kss::allIndices(*target_));
  });
  if (guess && !target.bulk.holds(
                   (*guess * source.bulk.middle.homogeneous()).template head<3>()))
    throw std::invalid_argument("The guess takes the source far away from the target: "
                                "is it in the units of the clouds?");
  return {source, target};
}

template <typename PointSource, typename PointTarget, typename Scalar>
kss::Alignment&
KSSICP<PointSource, PointTarget, Scalar>::alignmentForSettings()
{
  if (!alignment_ || !kss::sameWork(alignment_->settings(), settings_))
    alignment_ = std::make_unique<kss::Alignment>(settings_);
  return *alignment_;
}

template <typename PointSource, typename PointTarget, typename Scalar>
void
KSSICP<PointSource, PointTarget, Scalar>::giveUp(const Matrix4& guess,
                                                 const kss::Failure& failure)
{
  PCL_ERROR("[pcl::%s] %s\n", getClassName().c_str(), failure.reason.c_str());
  failure_ = failure;
  converged_ = false;
  final_transformation_ = kss::isSimilarity(guess.template cast<double>())
                              ? guess
                              : Matrix4(Matrix4::Identity());
  transformation_ = previous_transformation_ = Matrix4::Identity();
  nr_iterations_ = 0;
  correspondences_->clear();
  alternatives_.clear();
  far_points_ = {};
  precision_ = {};
  stages_.restart({});
  device_name_.clear();
}

template <typename PointSource, typename PointTarget, typename Scalar>
void
KSSICP<PointSource, PointTarget, Scalar>::transformCloud(const PointCloudSource& input,
                                                         PointCloudSource& output,
                                                         const Matrix4& transform)
{
  if (!place(input, output, transform))
    throw kss::NoPose();
}

template <typename PointSource, typename PointTarget, typename Scalar>
bool
KSSICP<PointSource, PointTarget, Scalar>::place(const PointCloudSource& input,
                                                PointCloudSource& output,
                                                const Matrix4& transform)
{
  const Eigen::Matrix4d matrix = transform.template cast<double>();
  const Eigen::Affine3d similarity(matrix);
  const Eigen::Matrix3d rotation = similarity.linear() / kss::scaleOf(matrix);
  bool all_finite = true;
  for (std::size_t i = 0; i < input.size(); ++i) {
    const Eigen::Vector3f point = input[i].getVector3fMap();
    if (!point.allFinite())
      continue;
    const Eigen::Vector3f placed = (similarity * point.cast<double>()).cast<float>();
    all_finite = all_finite && placed.allFinite();
    output[i].getVector3fMap() = placed;
    if constexpr (traits::has_normal<PointSource>::value)
      output[i].getNormalVector3fMap() =
          (rotation * input[i].getNormalVector3fMap().template cast<double>())
              .template cast<float>();
  }
  return all_finite;
}

template <typename PointSource, typename PointTarget, typename Scalar>
double
KSSICP<PointSource, PointTarget, Scalar>::getFitnessScore(double max_range,
                                                          bool use_indices)
{
  double sum = 0.0;
  std::size_t pairs = 0;
  if (input_ && target_ && tree_->getInputCloud()) {
    PointCloudSource aligned;
    if (source_is_output_ || !use_indices)
      aligned = *input_;
    else
      copyIndexedSource(aligned);
    if (!source_is_output_)
      place(aligned, aligned, final_transformation_);
    Indices index(1);
    std::vector<float> squared(1);
    for (const PointSource& point : aligned) {
      if (!point.getVector3fMap().allFinite() ||
          tree_->nearestKSearchT(point, 1, index, squared) < 1 ||
          squared[0] > max_range)
        continue;
      sum += squared[0];
      ++pairs;
    }
  }
  return pairs > 0 ? sum / pairs : std::numeric_limits<double>::max();
}

template <typename PointSource, typename PointTarget, typename Scalar>
bool
KSSICP<PointSource, PointTarget, Scalar>::registerVisualizationCallback(
    std::function<UpdateVisualizerCallbackSignature>& callback)
{
  if (input_ && target_)
    return Base::registerVisualizationCallback(callback);
  if (!callback)
    return false;
  update_visualizer_ = callback;
  return true;
}

template <typename PointSource, typename PointTarget, typename Scalar>
double
KSSICP<PointSource, PointTarget, Scalar>::getScale() const
{
  return kss::scaleOf(final_transformation_.template cast<double>());
}

template <typename PointSource, typename PointTarget, typename Scalar>
kss::Mode
KSSICP<PointSource, PointTarget, Scalar>::getFoundMode() const
{
  return settings_.mode == kss::Mode::AUTOMATIC && !alternatives_.empty()
             ? kss::modeOf(getOverlap())
             : settings_.mode;
}

template <typename PointSource, typename PointTarget, typename Scalar>
void
KSSICP<PointSource, PointTarget, Scalar>::take(const kss::Settings& asked)
{
  const kss::CheckedSettings checked = kss::checked(asked, settings_);
  for (const std::string& refusal : checked.refusals)
    PCL_ERROR("[pcl::%s] %s\n", getClassName().c_str(), refusal.c_str());
  settings_ = checked.settings;
}

template <typename PointSource, typename PointTarget, typename Scalar>
template <typename Value>
void
KSSICP<PointSource, PointTarget, Scalar>::set(Value kss::Settings::*setting,
                                              const Value& value)
{
  kss::Settings asked = settings_;
  asked.*setting = value;
  take(asked);
}

template <typename PointSource, typename PointTarget, typename Scalar>
void
KSSICP<PointSource, PointTarget, Scalar>::setScaleRange(double smallest, double largest)
{
  kss::Settings asked = settings_;
  asked.smallest_scale = smallest;
  asked.largest_scale = largest;
  take(asked);
}

template <typename PointSource, typename PointTarget, typename Scalar>
void
KSSICP<PointSource, PointTarget, Scalar>::setSettings(const kss::Settings& settings)
{
  take(settings);
  if (kss::searchOf(settings_) != settings_.search)
    PCL_WARN("[pcl::%s] The search is exact: only with the truncated mean and spread "
             "centres can it be screened.\n",
             getClassName().c_str());
}

} // namespace pcl

#include <pcl/registration/impl/kss_icp_final.hpp>
#include <pcl/registration/impl/kss_icp_misfit.hpp>
