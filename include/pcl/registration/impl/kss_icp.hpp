/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/console/print.h>
#include <pcl/registration/kss/cloud_conversion.h>
#include <pcl/registration/kss/hand_off_criteria.h>
#include <pcl/registration/kss/naming.h>
#include <pcl/registration/kss/tracked_correspondences.h>
#include <pcl/registration/kss_icp.h>

#include <algorithm>
#include <numeric>
#include <stdexcept>

namespace pcl {
namespace kss {

/** \brief ICP on the clouds can cost a pose the lead that it had among the simplified
 * ones: then the next one gets its chance, so often at most. */
constexpr int most_hand_offs = 3;

/** \brief Correspondences of the final ICP are no longer than so many spacings. */
constexpr double hand_off_reach = 4.0;

/** \brief The share of the score that a pose may lose to the final ICP: what chance
 * causes. */
constexpr double hand_off_loss = 0.01;

/** \brief Thrown through ICP where its transformation is none that points can follow:
 * PCL asserts that they are finite. */
struct NoPose {};

} // namespace kss

template <typename PointSource, typename PointTarget, typename Scalar>
KSSICP<PointSource, PointTarget, Scalar>::KSSICP()
{
  reg_name_ = "KSSICP";
  this->max_iterations_ = 300;
  this->euclidean_fitness_epsilon_ = 1e-5;
  convergence_criteria_.reset(new kss::HandOffCriteria<Scalar>(
      nr_iterations_, transformation_, *correspondences_));
  convergence_criteria_->setAbsoluteMSE(0.0);
  convergence_criteria_->setFailureAfterMaximumIterations(true);
  correspondence_estimation_.reset(
      new kss::TrackedCorrespondences<PointSource, PointTarget, Scalar>);
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
  stop_.restart(time_limit_);
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
    stop_.restart(time_limit_);
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
  const bool has_guess = guess != Matrix4::Identity();
  const Eigen::Matrix4d guessed = guess.template cast<double>();
  if (has_guess && !kss::isSimilarity(guessed))
    throw std::invalid_argument(
        "The guess is not a rotation, translation and positive scale.");

  // clouds
  const kss::UsablePoints source_points =
      kss::naming("source", [&] { return kss::usablePoints(*input_, *indices_); });
  const kss::UsablePoints target_points = kss::naming(
      "target", [&] { return kss::usablePoints(*target_, kss::allIndices(*target_)); });
  far_points_ = {source_points.far, target_points.far};
  if (has_guess &&
      !target_points.bulk.holds(
          (guessed * source_points.bulk.middle.homogeneous()).template head<3>()))
    throw std::invalid_argument("The guess takes the source far away from the target: "
                                "is it in the units of the clouds?");

  // simplification, pre-shape, {O}, energies, minima, ICP on each
  if (alignment_ && kss::sameWork(alignment_->settings(), settings_))
    alignment_->setProgress(settings_.progress);
  else
    alignment_ = std::make_unique<kss::Alignment>(settings_);
  kss::Alignment& alignment = *alignment_;
  alignment.setClouds(kss::toLocalCloud(*input_, source_points),
                      kss::toLocalCloud(*target_, target_points),
                      has_guess ? kss::scaleOf(guessed) : 1.0);
  if (has_guess)
    alignment.throwIfUndetermined(kss::scaleOf(guessed));
  const kss::Alternatives found = alignment.align();
  device_name_ = alignment.deviceName();

  // ICP on the clouds themselves
  report("hand-off", 0.0);
  if (auto* criteria =
          dynamic_cast<kss::HandOffCriteria<Scalar>*>(convergence_criteria_.get()))
    criteria->setRoundingError(kss::roundingError(*target_, target_points.indices));
  Indices used = kss::spread(source_points.indices, settings_.icp_points);
  kss::sortInSpace(*input_, used);
  const auto source = pcl::make_shared<PointCloudSource>();
  source->header = input_->header;
  source->reserve(used.size());
  for (const index_t i : used) // may name points more than once
    source->push_back((*input_)[i]);
  std::vector<Contender> contenders;
  for (const Alternative& alternative : found)
    contenders.push_back({alternative, {}});
  std::string stopped;
  try {
    if (has_guess) {
      contenders.push_back({alignment.judge(guessed), {}});
      contenders.back() = handOff(source, contenders.back());
    }
    settle(source, contenders);
  }
  catch (const kss::Stopped& stop) {
    stopped = stop.what();
    rank(contenders); // and the best so far has to do
  }
  accept(contenders.front(), used);
  for (const Contender& contender : contenders)
    if (std::none_of(alternatives_.begin(), alternatives_.end(),
                     [&](const Alternative& listed) {
                       return alignment.same(listed.transformation,
                                             contender.pose.transformation);
                     }))
      alternatives_.push_back(contender.pose);
  report("hand-off", 1.0);
  alignment.clock().lap("hand-off");
  stage_seconds_ = alignment.clock().stages();
  judgeResult(stopped);
}

template <typename PointSource, typename PointTarget, typename Scalar>
void
KSSICP<PointSource, PointTarget, Scalar>::rank(std::vector<Contender>& contenders)
{
  std::stable_sort(contenders.begin(), contenders.end(),
                   [](const Contender& a, const Contender& b) {
                     return a.pose.overlap.score > b.pose.overlap.score;
                   });
}

template <typename PointSource, typename PointTarget, typename Scalar>
void
KSSICP<PointSource, PointTarget, Scalar>::settle(const PointCloudSourceConstPtr& source,
                                                 std::vector<Contender>& contenders)
{
  rank(contenders);
  for (int runs = 0; runs < kss::most_hand_offs && !contenders.front().run; ++runs) {
    // where nothing fits, one run is enough to say so
    if (runs > 0 &&
        kss::confidenceOf(contenders.front().pose.overlap) < minimum_confidence_)
      break;
    contenders.front() = handOff(source, contenders.front());
    rank(contenders);
  }
  const auto best =
      std::find_if(contenders.begin(), contenders.end(),
                   [](const Contender& contender) { return contender.run != nullptr; });
  std::rotate(contenders.begin(), best, best + 1);
}

template <typename PointSource, typename PointTarget, typename Scalar>
typename KSSICP<PointSource, PointTarget, Scalar>::Contender
KSSICP<PointSource, PointTarget, Scalar>::handOff(
    const PointCloudSourceConstPtr& source, const Contender& contender)
{
  const kss::Alignment& alignment = *alignment_;
  const Eigen::Matrix4d& pose = contender.pose.transformation;

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
        std::min(corr_dist_threshold_, kss::hand_off_reach * alignment.spacing(pose));
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
  HandOff run{final_transformation_, transformation_, previous_transformation_,
              nr_iterations_,        converged_,      *correspondences_};

  // an estimation can be singular, and nearest points lead astray where noise is heavy
  Alternative after = contender.pose;
  if (is_pose)
    after = alignment.judge(final_transformation_.template cast<double>());
  if (!is_pose ||
      after.overlap.score < (1.0 - kss::hand_off_loss) * contender.pose.overlap.score) {
    after = contender.pose;
    run.transformation = pose.cast<Scalar>();
    run.converged = true;
  }
  return {after, std::make_shared<HandOff>(run)};
}

template <typename PointSource, typename PointTarget, typename Scalar>
void
KSSICP<PointSource, PointTarget, Scalar>::accept(const Contender& contender,
                                                 const Indices& source_indices)
{
  alternatives_.assign(1, contender.pose);
  correspondences_->clear();
  if (!contender.run) {
    final_transformation_ = contender.pose.transformation.template cast<Scalar>();
    return;
  }
  const HandOff& run = *contender.run;
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
KSSICP<PointSource, PointTarget, Scalar>::judgeResult(const std::string& stopped)
{
  if (!stopped.empty())
    failure_ = {kss::FailureCause::STOPPED,
                stopped + "; the pose is the best one so far."};
  else if (!converged_)
    failure_ = {kss::FailureCause::UNSETTLED, "The final ICP still moved after " +
                                                  std::to_string(nr_iterations_) +
                                                  " iterations; allow more of them."};
  else if (getConfidence() < minimum_confidence_)
    failure_ = {kss::FailureCause::NO_FIT,
                "The clouds do not fit: at the best pose " +
                    kss::percent(getOverlap().source) + " of the source and " +
                    kss::percent(getOverlap().target) +
                    " of the target lie on the other cloud, too little or too "
                    "loosely; do they show the same object?"};
  converged_ = failure_.cause == kss::FailureCause::NONE;
  if (!converged_)
    PCL_WARN("[pcl::%s] %s\n", getClassName().c_str(), failure_.reason.c_str());
}

template <typename PointSource, typename PointTarget, typename Scalar>
void
KSSICP<PointSource, PointTarget, Scalar>::report(const char* stage, double done) const
{
  if (settings_.progress)
    settings_.progress(stage, done);
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
  stage_seconds_.clear();
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
KSSICP<PointSource, PointTarget, Scalar>::getFitnessScore(double max_range)
{
  double sum = 0.0;
  std::size_t pairs = 0;
  if (input_ && target_ && tree_->getInputCloud()) {
    PointCloudSource aligned;
    if (source_is_output_)
      aligned = *input_;
    else {
      copyIndexedSource(aligned);
      place(aligned, aligned, final_transformation_);
    }
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
template <typename Value>
void
KSSICP<PointSource, PointTarget, Scalar>::set(Value& setting,
                                              const Value& value,
                                              bool sensible,
                                              const char* refusal)
{
  if (sensible)
    setting = value;
  else
    PCL_ERROR("[pcl::%s::%s\n", getClassName().c_str(), refusal);
}

template <typename PointSource, typename PointTarget, typename Scalar>
void
KSSICP<PointSource, PointTarget, Scalar>::setNumberOfSamplePoints(unsigned int points)
{
  set(settings_.sample_points, points, points >= 20,
      "setNumberOfSamplePoints] At least 20 points are needed.");
}

template <typename PointSource, typename PointTarget, typename Scalar>
void
KSSICP<PointSource, PointTarget, Scalar>::setAngleStep(double radians)
{
  set(settings_.angle_step, radians, radians >= 0.05 && radians <= M_PI,
      "setAngleStep] The step must lie between 0.05 and pi.");
}

template <typename PointSource, typename PointTarget, typename Scalar>
void
KSSICP<PointSource, PointTarget, Scalar>::setNumberOfEvenRotations(
    unsigned int rotations)
{
  set(settings_.even_rotations, rotations, rotations >= 1 && rotations <= 100000,
      "setNumberOfEvenRotations] The number must lie between 1 and 100000.");
}

template <typename PointSource, typename PointTarget, typename Scalar>
void
KSSICP<PointSource, PointTarget, Scalar>::setLocalMinimumKernel(unsigned int edge)
{
  set(settings_.local_minimum_kernel, edge, edge >= 3,
      "setLocalMinimumKernel] The edge must be at least 3.");
}

template <typename PointSource, typename PointTarget, typename Scalar>
void
KSSICP<PointSource, PointTarget, Scalar>::setAdditionalProcessThreshold(
    double threshold)
{
  set(settings_.additional_process_threshold, threshold, threshold >= 0.0,
      "setAdditionalProcessThreshold] The threshold must not be negative.");
}

template <typename PointSource, typename PointTarget, typename Scalar>
void
KSSICP<PointSource, PointTarget, Scalar>::setScaleRange(double smallest, double largest)
{
  if (smallest >= 0.0 && smallest <= largest && largest > 0.0) {
    settings_.smallest_scale = smallest;
    settings_.largest_scale = largest;
  }
  else
    PCL_ERROR("[pcl::%s::setScaleRange] The smallest scale must be at least 0, and no "
              "more than the largest.\n",
              getClassName().c_str());
}

template <typename PointSource, typename PointTarget, typename Scalar>
void
KSSICP<PointSource, PointTarget, Scalar>::setTimeLimit(double seconds)
{
  set(time_limit_, seconds, seconds >= 0.0,
      "setTimeLimit] The limit must be at least 0 seconds; 0 is none.");
}

template <typename PointSource, typename PointTarget, typename Scalar>
void
KSSICP<PointSource, PointTarget, Scalar>::setMinimumConfidence(double confidence)
{
  set(minimum_confidence_, confidence, confidence >= 0.0 && confidence <= 1.0,
      "setMinimumConfidence] The confidence must lie between 0 and 1.");
}

template <typename PointSource, typename PointTarget, typename Scalar>
void
KSSICP<PointSource, PointTarget, Scalar>::setSettings(const kss::Settings& settings)
{
  const kss::Settings checked = settings_;
  settings_ = settings;
  settings_.sample_points = checked.sample_points;
  settings_.search_points = checked.search_points;
  settings_.angle_step = checked.angle_step;
  settings_.even_rotations = checked.even_rotations;
  settings_.local_minimum_kernel = checked.local_minimum_kernel;
  settings_.additional_process_threshold = checked.additional_process_threshold;
  settings_.smallest_scale = checked.smallest_scale;
  settings_.largest_scale = checked.largest_scale;
  setNumberOfSamplePoints(settings.sample_points);
  set(settings_.search_points, settings.search_points,
      settings.search_points >= 1 && settings.search_points <= 128,
      "setSettings] The number of search points must lie between 1 and 128.");
  setAngleStep(settings.angle_step);
  setNumberOfEvenRotations(settings.even_rotations);
  setLocalMinimumKernel(settings.local_minimum_kernel);
  setAdditionalProcessThreshold(settings.additional_process_threshold);
  setScaleRange(settings.smallest_scale, settings.largest_scale);
}

} // namespace pcl
