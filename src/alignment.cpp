/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include <pcl/registration/kss/alignment.h>
#include <pcl/registration/kss/candidate_rotations.h>
#include <pcl/registration/kss/local_minima.h>
#include <pcl/registration/kss/refinement.h>
#include <pcl/registration/kss/simplification.h>

#include "parallel.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <stdexcept>

namespace pcl {
namespace kss {
namespace {

/** Rotations that differ by less, in radians, and poses that place the source less far
 * apart, root mean square, in its root mean square radius, are one and the same. */
constexpr double distinct = M_PI / 18.0;

/** Minima that get the full refinement, after a rough one of all. */
constexpr std::size_t finalists = 10;

/** A rough refinement of all minima tells which of them are worth a full one. */
constexpr Refinement::Effort rough{400, 15, 1e-3};
constexpr Refinement::Effort full{1000, 40, 1e-4};

Eigen::Matrix4d
poseOf(const Eigen::Quaterniond& rotation)
{
  Eigen::Matrix4d pose = Eigen::Matrix4d::Identity();
  pose.topLeftCorner<3, 3>() = rotation.toRotationMatrix();
  return pose;
}

/** Mean distance between neighbouring samples. */
double
samplingDistance(const Points& points)
{
  double sum = 0.0;
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    Eigen::RowVectorXf squared =
        (points.colwise() - points.col(i)).colwise().squaredNorm();
    squared[i] = std::numeric_limits<float>::max();
    sum += std::sqrt(squared.minCoeff());
  }
  return sum / points.cols();
}

/** A cloud's error with the cloud's name before it. */
template <typename Work>
auto
naming(const char* cloud, const Work& work)
{
  try {
    return work();
  }
  catch (const std::invalid_argument& error) {
    throw std::invalid_argument(std::string("The ") + cloud +
                                " cloud determines no pose: " + error.what() + ".");
  }
}

} // namespace

Alignment::Alignment(const Settings& settings)
: settings_(settings)
, evaluator_(makeEvaluator(settings))
{
}

void
Alignment::setClouds(const LocalCloud& source,
                     const LocalCloud& target,
                     double known_scale)
{
  clock_.restart();
  report("simplification", 0.0);
  // Both get the same number of points: pre-shape space asks for it.
  unsigned int k = settings_.sample_points;
  if (settings_.density == Density::UNIFORM) {
    k = evenSampleSize(source.points, k, settings_.threads);
    report("simplification", 0.25);
    k = std::min(k, evenSampleSize(target.points, k, settings_.threads));
    report("simplification", 0.5);
  }
  const auto simplified = [&](const LocalCloud& cloud) {
    return LocalCloud{simplify(cloud.points, k, settings_.density, settings_.threads),
                      cloud.origin};
  };
  source_ = naming("source", [&] { return toPreShape(simplified(source)); });
  report("simplification", 0.75);
  target_ = naming("target", [&] { return toPreShape(simplified(target)); });
  if (!settings_.estimate_scale)
    source_ = withSize(source_, target_.size / known_scale);
  sampling_distance_ =
      std::max(samplingDistance(source_.points), samplingDistance(target_.points));
  evaluator_->setClouds(source_.points, target_.points);
  report("simplification", 1.0);
  clock_.lap("simplification");
}

Alternatives
Alignment::align()
{
  // E_d of (e9) for all candidates of (e10), in one dispatch
  report("search", 0.0);
  const auto candidates = candidateRotations(settings_);
  Poses poses;
  for (const Eigen::Quaterniond& rotation : candidates->rotations())
    poses.push_back(poseOf(rotation));
  const std::vector<float> energies = energiesOf(poses);
  report("search", 1.0);
  clock_.lap("search");

  // O_init of (e10) first, then the rest of {O_local} of (e12)
  Poses minima;
  for (const std::size_t i :
       localMinima(energies, *candidates, settings_.local_minimum_kernel, distinct))
    minima.push_back(poses[i]);
  clock_.lap("minima");

  // T O_init of (e11); the additional process of (e12) where it is not good enough
  report("refinement", 0.0);
  Alternatives alternatives = refined({minima.front()});
  if (alternatives.front().energy > settings_.additional_process_threshold)
    alternatives = refined(minima);
  report("refinement", 1.0);
  clock_.lap("refinement");
  return alternatives;
}

Alternatives
Alignment::refined(const Poses& minima)
{
  const Refinement refinement(source_.points, target_.points);
  const auto improve = [&](Poses poses, const Refinement::Effort& effort) {
    const auto size = static_cast<std::ptrdiff_t>(poses.size());
#pragma omp parallel for schedule(dynamic) num_threads(threadCount(settings_.threads))
    for (std::ptrdiff_t i = 0; i < size; ++i)
      poses[i] = refinement.refine(poses[i], settings_.estimate_scale, effort);
    return poses;
  };
  Poses poses = distinctByEnergy(improve(minima, rough));
  if (poses.size() > finalists)
    poses.resize(finalists);
  report("refinement", 0.5);
  poses = distinctByEnergy(improve(poses, full));

  Alternatives alternatives;
  const std::vector<float> energies = energiesOf(poses);
  for (std::size_t i = 0; i < poses.size(); ++i)
    alternatives.push_back({fromPreShape(poses[i], source_, target_), energies[i]});
  return alternatives;
}

Alignment::Poses
Alignment::distinctByEnergy(const Poses& poses)
{
  const std::vector<float> energies = energiesOf(poses);
  std::vector<std::size_t> order(poses.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return energies[a] < energies[b];
  });
  Poses kept;
  for (const std::size_t i : order)
    if (std::none_of(kept.begin(), kept.end(), [&](const Eigen::Matrix4d& pose) {
          return displacement(pose, poses[i]) < distinct;
        }))
      kept.push_back(poses[i]);
  return kept;
}

Alternative
Alignment::judge(const Eigen::Matrix4d& transformation)
{
  return {transformation,
          energiesOf({toPreShapePose(transformation, source_, target_)}).front()};
}

double
Alignment::residual(const Eigen::Matrix4d& transformation)
{
  return distancesOf({toPreShapePose(transformation, source_, target_)})
             .front()
             .mean() /
         sampling_distance_;
}

bool
Alignment::same(const Eigen::Matrix4d& a, const Eigen::Matrix4d& b) const
{
  return displacement(toPreShapePose(a, source_, target_),
                      toPreShapePose(b, source_, target_)) < distinct;
}

std::string
Alignment::deviceName() const
{
  return evaluator_->deviceName();
}

StageClock&
Alignment::clock()
{
  return clock_;
}

double
Alignment::displacement(const Eigen::Matrix4d& a, const Eigen::Matrix4d& b) const
{
  const Eigen::Matrix<float, 3, 4> difference = (a - b).topRows<3>().cast<float>();
  return (difference * source_.points.colwise().homogeneous()).norm() /
         std::sqrt(static_cast<double>(source_.points.cols()));
}

std::vector<HausdorffDistances>
Alignment::distancesOf(const Poses& poses)
{
  std::vector<Placement> placements;
  for (const Eigen::Matrix4d& pose : poses)
    placements.push_back(pose.topRows<3>().cast<float>());
  return evaluator_->evaluate(placements);
}

std::vector<float>
Alignment::energiesOf(const Poses& poses)
{
  std::vector<float> energies;
  for (const HausdorffDistances& distances : distancesOf(poses))
    energies.push_back(distances.hausdorff());
  return energies;
}

void
Alignment::report(const char* stage, double done) const
{
  if (settings_.progress)
    settings_.progress(stage, done);
}

} // namespace kss
} // namespace pcl
