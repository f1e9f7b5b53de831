/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include <pcl/registration/kss/alignment.h>
#include <pcl/registration/kss/cleaning.h>
#include <pcl/registration/kss/simplification.h>

#include "median.h"
#include "parallel.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace pcl {
namespace kss {
namespace {

// Lengths are in root mean square radii of the target.

/** Beyond this length a distance does not count in the search: about as far as a
 * candidate next to the right pose leaves points off. */
constexpr float search_limit = 0.35f;

/** Points of a cloud that take part in refinement and judgement at most. */
constexpr unsigned int most_points = 12000;

/** Means of a noisy cloud. */
constexpr unsigned int most_means = 2500;

/** Minima of an energy that are refined at most. */
constexpr std::size_t most_minima = 300;

/** Poses that place the source less far apart, root mean square, are the same; and
 * rotations that differ by less, in radians. */
constexpr double same_pose = M_PI / 18.0;

/** Poses that are listed. */
constexpr std::size_t most_alternatives = 5;

/** Points of each cloud whose correspondences decide in the end. */
constexpr Eigen::Index most_probes = 2500;

/** How far the size of a part can be from that of the whole. */
constexpr double smallest_part = 0.35;

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

/** The points of a cloud that refinement and judgement work with. */
LocalCloud
prepared(const LocalCloud& cloud, const Settings& settings)
{
  Points points = withoutCopies(thinned(cloud.points, most_points));
  if (settings.clean)
    points = withoutStrayPoints(points, settings.threads);
  return {points, cloud.origin};
}

/** The poses, and the best of them turned a little about each axis: noise gives the
 * energy shallow minima beside the right one. */
std::vector<Eigen::Matrix4d>
withTurnedOnes(std::vector<Eigen::Matrix4d> poses)
{
  for (std::size_t i = 0, n = std::min<std::size_t>(2, poses.size()); i < n; ++i)
    for (int axis = 0; axis < 3; ++axis)
      for (const double angle : {-0.3, -0.15, 0.15, 0.3}) {
        Eigen::Matrix4d turned = poses[i];
        turned.topLeftCorner<3, 3>() *=
            Eigen::AngleAxisd(angle, Eigen::Vector3d::Unit(axis)).toRotationMatrix();
        poses.push_back(turned);
      }
  return poses;
}

/** Every so-manieth point, at most so many. */
Points
someOf(const Points& points, Eigen::Index most)
{
  const Eigen::Index size = std::min(most, points.cols());
  Points rest(3, size);
  for (Eigen::Index i = 0; i < size; ++i)
    rest.col(i) = points.col(i * points.cols() / size);
  return rest;
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
  report("preparation", 0.0);
  LocalCloud clean_source = prepared(source, settings_);
  report("preparation", 0.4);
  LocalCloud clean_target = prepared(target, settings_);
  report("preparation", 0.8);
  is_noisy_ = settings_.clean && (isNoisy(clean_source.points, settings_.threads) ||
                                  isNoisy(clean_target.points, settings_.threads));
  if (is_noisy_)
    averageNoise(clean_source.points, clean_target.points, most_means,
                 settings_.threads);
  report("preparation", 1.0);
  clock_.lap("preparation");

  // Both get the same number of points: pre-shape space asks for it.
  report("simplification", 0.0);
  unsigned int k = settings_.sample_points;
  if (settings_.density == Density::UNIFORM) {
    k = evenSampleSize(clean_source.points, k, settings_.threads);
    k = std::min(k, evenSampleSize(clean_target.points, k, settings_.threads));
  }
  const auto simplified = [&](const LocalCloud& cloud) {
    return toPreShape({inFarthestOrder(simplify(cloud.points, k, settings_.density,
                                                settings_.threads)),
                       cloud.origin});
  };
  PreShape small_source = naming("source", [&] { return simplified(clean_source); });
  PreShape small_target = naming("target", [&] { return simplified(clean_target); });
  if (!settings_.estimate_scale)
    small_source = withSize(small_source, small_target.size / known_scale);
  evaluator_->setClouds(small_source.points, small_target.points,
                        settings_.energy == Energy::HAUSDORFF
                            ? std::numeric_limits<float>::max()
                            : search_limit);
  const auto shape = [&](const PreShape& small, const LocalCloud& cloud) {
    const Eigen::Vector3f center = (small.center - cloud.origin).cast<float>();
    return Shape{small, NearestPoints((cloud.points.colwise() - center) /
                                          static_cast<float>(small.size),
                                      settings_.threads)};
  };
  source_.emplace(shape(small_source, clean_source));
  target_.emplace(shape(small_target, clean_target));
  report("simplification", 1.0);
  clock_.lap("simplification");
}

Alternatives
Alignment::align()
{
  // E_d of (e9) or E_cd of (e122) for all candidates, and their minima
  report("search", 0.0);
  const std::vector<Minimum> minima = localMinima();
  report("search", 1.0);
  clock_.lap("search");

  // T O_init of (e11); the additional process of (e12) where it is not good enough
  report("refinement", 0.0);
  const Minimum& initial = minima.front();
  const double threshold = settings_.additional_process_threshold;
  Poses poses;
  if (threshold > 0.0)
    poses = refined({initial.pose}, 0.0, 0.2);
  if (poses.empty() || energyAt(poses.front(), initial.weights) > threshold) {
    poses.clear();
    for (const Minimum& minimum : minima)
      poses.push_back(minimum.pose);
    poses = refined(poses, threshold > 0.0 ? 0.2 : 0.0, 1.0);
  }
  Alternatives alternatives;
  for (const Eigen::Matrix4d& pose : poses)
    alternatives.push_back(
        {fromPreShape(pose, source_->simplified, target_->simplified),
         overlapAt(source_->all, target_->all, pose)});
  report("refinement", 1.0);
  clock_.lap("refinement");
  return alternatives;
}

std::vector<Alignment::Minimum>
Alignment::localMinima()
{
  std::vector<Minimum> minima;
  for (const Sweep& sweep : sweepsOf(settings_, source_->simplified.points,
                                     target_->simplified.points, scaleRange())) {
    const auto energies = energiesOf(sweep);
    for (std::size_t e = 0; e < energies.size(); ++e) {
      auto found = sweep.candidates.localMinima(
          energies[e], settings_.local_minimum_kernel, same_pose);
      found.resize(std::min(found.size(), most_minima));
      for (const std::size_t i : found)
        minima.push_back({sweep.candidates.pose(i), energies[e][i], sweep.energies[e]});
    }
  }
  // (c_init, O_init) of (e10) or (e13) comes first
  std::iter_swap(minima.begin(),
                 std::min_element(minima.begin(), minima.end(),
                                  [](const Minimum& a, const Minimum& b) {
                                    return a.energy < b.energy;
                                  }));
  return minima;
}

std::vector<std::vector<float>>
Alignment::energiesOf(const Sweep& sweep)
{
  // Algorithm 2 for all candidates, so many at once
  constexpr std::size_t batch = 1 << 16;
  const std::size_t size = sweep.candidates.size();
  std::vector<std::vector<float>> energies(sweep.energies.size());
  for (std::size_t begin = 0; begin < size; begin += batch) {
    const auto distances = evaluator_->evaluate(
        sweep.candidates.placements(begin, std::min(batch, size - begin)));
    for (std::size_t e = 0; e < energies.size(); ++e)
      for (const DirectedDistances& d : distances)
        energies[e].push_back(energyOf(d, sweep.energies[e], settings_.energy));
    report("search", static_cast<double>(begin) / size);
  }
  return energies;
}

double
Alignment::energyAt(const Eigen::Matrix4d& pose, const Weights& weights)
{
  const Placement placement = pose.topRows<3>().cast<float>();
  return energyOf(evaluator_->evaluate({placement}).front(), weights, settings_.energy);
}

Alignment::Poses
Alignment::refined(Poses poses, double begin, double end)
{
  const auto done = [&](double share) {
    report("refinement", begin + share * (end - begin));
  };
  // All minima are refined with few points, and fewer and fewer of them with more.
  // First they are ranked by how near the clouds come to each other, which leads from
  // afar, in the end by their overlap, which tells right from wrong.
  const ScaleRange scales = scaleRange();
  const Refinement on_samples(source_->simplified.points, target_->simplified.points,
                              source_->all, target_->all, scales);
  const double sample = 2.0 / std::sqrt(target_->simplified.points.cols());
  const double near = std::max(0.06, 1.5 * sample);
  const auto distance = [this](Eigen::Index points, double limit) {
    return [this, points, limit](const Eigen::Matrix4d& pose) {
      return truncatedMean(pose, points, limit);
    };
  };
  poses = refined(poses, on_samples, {96, 8, search_limit, 0.12, false},
                  distance(96, 0.15), 0.15, 120);
  done(0.3);
  poses = refined(poses, on_samples, {400, 12, 0.12, near, false},
                  distance(400, std::max(0.1, near)), 0.12, 30);
  done(0.6);

  const auto misfit = [this](const Eigen::Matrix4d& pose) {
    return -overlapAt(source_->all, target_->all, pose).score;
  };
  const double spacing =
      std::max(scaleOf(poses.front()) * median(source_->all.spacing()),
               static_cast<double>(median(target_->all.spacing())));
  const Refinement::Effort fine{600, 40, std::max(near, 4.0 * spacing), spacing, true};
  poses = refined(poses, on_samples, fine, misfit, same_pose, most_alternatives);
  if (is_noisy_)
    poses = refined(withTurnedOnes(poses), on_samples, fine, misfit, same_pose,
                    most_alternatives);
  done(0.9);
  const Points source_probes = someOf(source_->all.points(), most_probes);
  const Points target_probes = someOf(target_->all.points(), most_probes);
  const Refinement on_clouds(source_probes, target_probes, source_->all, target_->all,
                             scales);
  return refined(poses, on_clouds, {most_probes, 100, 4.0 * spacing, spacing, true},
                 misfit, same_pose, most_alternatives);
}

template <typename Badness>
Alignment::Poses
Alignment::refined(const Poses& poses,
                   const Refinement& refinement,
                   const Refinement::Effort& effort,
                   const Badness& badness,
                   double distinct,
                   std::size_t most) const
{
  struct Ranked {
    Eigen::Matrix4d pose;
    double badness;
  };
  std::vector<Ranked> ranked(poses.size());
  const auto size = static_cast<std::ptrdiff_t>(poses.size());
#pragma omp parallel for schedule(dynamic) num_threads(threadCount(settings_.threads))
  for (std::ptrdiff_t i = 0; i < size; ++i) {
    ranked[i].pose = refinement.refine(poses[i], effort);
    ranked[i].badness = badness(ranked[i].pose);
  }
  std::stable_sort(ranked.begin(), ranked.end(), [](const Ranked& a, const Ranked& b) {
    return a.badness < b.badness;
  });
  Poses kept;
  for (const Ranked& candidate : ranked)
    if (kept.size() < most &&
        std::none_of(kept.begin(), kept.end(), [&](const Eigen::Matrix4d& pose) {
          return displacement(pose, candidate.pose) < distinct;
        }))
      kept.push_back(candidate.pose);
  return kept;
}

double
Alignment::truncatedMean(const Eigen::Matrix4d& pose,
                         Eigen::Index points,
                         double limit) const
{
  const auto mean = [points](const Points& probes, const NearestPoints& others,
                             const Eigen::Affine3f& placement, double most) {
    const Eigen::Index size = std::min(points, probes.cols());
    double sum = 0.0;
    for (Eigen::Index i = 0; i < size; ++i) {
      float squared;
      others.nearest(placement * probes.col(i), squared);
      sum += std::min<double>(std::sqrt(squared), most);
    }
    return sum / size;
  };
  const Eigen::Affine3f placement(pose.cast<float>());
  const double scale = scaleOf(pose);
  return mean(source_->simplified.points, target_->all, placement, limit) +
         scale * mean(target_->simplified.points, source_->all, placement.inverse(),
                      limit / scale);
}

ScaleRange
Alignment::scaleRange() const
{
  if (!settings_.estimate_scale)
    return {1.0, 1.0};
  const double unit = source_->simplified.size / target_->simplified.size;
  const ScaleRange asked{settings_.smallest_scale * unit,
                         settings_.largest_scale * unit};
  const ScaleRange range{std::max(smallest_part, asked.smallest),
                         std::min(1.0 / smallest_part, asked.largest)};
  return range.smallest <= range.largest ? range : asked;
}

Alternative
Alignment::judge(const Eigen::Matrix4d& transformation) const
{
  return {transformation, overlapAt(source_->all, target_->all,
                                    toPreShapePose(transformation, source_->simplified,
                                                   target_->simplified))};
}

bool
Alignment::same(const Eigen::Matrix4d& a, const Eigen::Matrix4d& b) const
{
  return displacement(toPreShapePose(a, source_->simplified, target_->simplified),
                      toPreShapePose(b, source_->simplified, target_->simplified)) <
         same_pose;
}

double
Alignment::spacing(const Eigen::Matrix4d& transformation) const
{
  return std::max(scaleOf(transformation) * source_->simplified.size *
                      median(source_->all.spacing()),
                  target_->simplified.size * median(target_->all.spacing()));
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
  constexpr Eigen::Index probes = 40;
  const Points& points = source_->simplified.points;
  const Eigen::Matrix<float, 3, 4> difference = (a - b).topRows<3>().cast<float>();
  const Eigen::Index size = std::min(probes, points.cols());
  return (difference * points.leftCols(size).colwise().homogeneous()).norm() /
         std::sqrt(static_cast<double>(size));
}

void
Alignment::report(const char* stage, double done) const
{
  if (settings_.progress)
    settings_.progress(stage, done);
}

} // namespace kss
} // namespace pcl
