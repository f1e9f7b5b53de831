/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "refinement/selection.h"

#include <pcl/registration/kss/detail/similarity.h>
#include <pcl/registration/kss/detail/stopping.h>

#include "geometry/median.h"
#include "support/parallel.h"

#include <algorithm>
#include <cmath>

namespace pcl {
namespace kss {
namespace {

// Lengths are in root mean square radii of the target.

/** How far a candidate next to the right pose leaves points off, about. */
constexpr double far = 0.35;

/** And what a few iterations from there leave. */
constexpr double near = 0.12;

/** Poses that are listed. */
constexpr std::size_t most_alternatives = 5;

/** A pose whose score is a smaller part of the best one's is not worth more work. */
constexpr double hopeless = 0.5;

/** Points of each cloud whose correspondences decide in the end. */
constexpr Eigen::Index most_probes = 2500;

/** Points of each cloud that tell the overlap of a pose on the way. */
constexpr Eigen::Index overlap_probes = 1000;

/** The poses, and each turned a little about each axis. */
std::vector<Eigen::Matrix4d>
withTurnedOnes(std::vector<Eigen::Matrix4d> poses)
{
  for (std::size_t i = 0, n = poses.size(); i < n; ++i)
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

Selection::Selection(const ShapePair& shapes, unsigned int threads)
: shapes_(shapes)
, threads_(threads)
{
}

std::vector<JudgedPose>
Selection::best(const std::vector<Eigen::Matrix4d>& poses,
                const std::function<void(double)>& done) const
{
  std::vector<Ranked> ranked;
  for (const Eigen::Matrix4d& pose : poses)
    ranked.push_back({pose, 0.0});
  try {
    refineMoreAndMore(ranked, done);
  }
  catch (const Stopped&) {
    // the best so far have to do
    ranked.resize(std::min(ranked.size(), most_alternatives));
  }
  std::vector<JudgedPose> judged;
  for (const Ranked& candidate : ranked)
    judged.push_back(
        {candidate.pose, overlapAt(*shapes_.source.all, *shapes_.target.all, candidate.pose)});
  std::stable_sort(judged.begin(), judged.end(),
                   [](const JudgedPose& a, const JudgedPose& b) {
                     return a.overlap.score > b.overlap.score;
                   });
  done(1.0);
  return judged;
}

void
Selection::refineMoreAndMore(std::vector<Ranked>& ranked,
                             const std::function<void(double)>& done) const
{
  const Refinement on_samples(shapes_.source.simplified.points, shapes_.target.simplified.points,
                              *shapes_.source.all, *shapes_.target.all, shapes_.scales);
  const double sample = 2.0 / std::sqrt(shapes_.target.simplified.points.cols());
  const double nearer = std::max(0.06, 1.5 * sample);

  // The first so many. \a hope: and no worse than that part of the best, negative.
  const auto first = [](const std::vector<Ranked>& ranked, std::size_t most,
                        double hope = 0.0) {
    Poses kept;
    for (const Ranked& candidate : ranked)
      if (kept.size() < most &&
          (hope == 0.0 || candidate.cost <= hope * ranked.front().cost))
        kept.push_back(candidate.pose);
    return kept;
  };
  const auto distance = [this](Eigen::Index points, double limit) {
    return [this, points, limit](const Eigen::Matrix4d& pose) {
      return truncatedMean(pose, points, limit);
    };
  };
  const auto misfit = [this](const Eigen::Matrix4d& pose) {
    return -overlapAt(*shapes_.source.all, *shapes_.target.all, pose,
                      shapes_.is_noisy ? most_probes : overlap_probes)
                .score;
  };

  ranked = refined(first(ranked, ranked.size()), on_samples, {64, 6, far, near, false},
                   distance(64, 0.15), 0.15);
  done(0.2);
  ranked = refined(first(ranked, 60), on_samples, {200, 8, near, nearer, false},
                   distance(200, std::max(0.1, nearer)), 0.12);
  done(0.4);
  const double spacing =
      std::max(scaleOf(ranked.front().pose) * median(shapes_.source.all->spacing()),
               static_cast<double>(median(shapes_.target.all->spacing())));
  const double wide = std::max(nearer, 4.0 * spacing);
  ranked = refined(first(ranked, shapes_.is_noisy ? 30 : 16), on_samples,
                   {400, 10, wide, 2.0 * spacing, shapes_.is_noisy}, misfit, same_pose);
  done(0.6);
  const Refinement::Effort fine{600, 40, wide, spacing, true};
  ranked = refined(first(ranked, most_alternatives, hopeless), on_samples, fine, misfit,
                   same_pose);
  if (shapes_.is_noisy)
    ranked =
        refined(withTurnedOnes(first(ranked, 2)), on_samples, fine, misfit, same_pose);
  done(0.8);

  const Points source_probes = someOf(shapes_.source.all->points(), most_probes);
  const Points target_probes = someOf(shapes_.target.all->points(), most_probes);
  const Refinement on_clouds(source_probes, target_probes, *shapes_.source.all, *shapes_.target.all,
                             shapes_.scales);
  ranked = refined(first(ranked, most_alternatives, hopeless), on_clouds,
                   {most_probes, 100, 4.0 * spacing, spacing, true}, misfit, same_pose);
}

template <typename Cost>
std::vector<Selection::Ranked>
Selection::refined(const Poses& poses,
                   const Refinement& refinement,
                   const Refinement::Effort& effort,
                   const Cost& cost,
                   double distinct) const
{
  std::vector<Ranked> ranked(poses.size());
  inParallel(poses.size(), threads_, 1, [&](std::ptrdiff_t i) {
    ranked[i].pose = refinement.refine(poses[i], effort);
    ranked[i].cost = cost(ranked[i].pose);
  });
  std::stable_sort(ranked.begin(), ranked.end(), [](const Ranked& a, const Ranked& b) {
    return a.cost < b.cost;
  });
  DistinctPoses distinct_poses(shapes_.metric, distinct);
  std::vector<Ranked> kept;
  for (const Ranked& candidate : ranked)
    if (distinct_poses.take(candidate.pose))
      kept.push_back(candidate);
  return kept;
}

double
Selection::truncatedMean(const Eigen::Matrix4d& pose,
                         Eigen::Index points,
                         double limit) const
{
  const auto mean = [points](const Points& probes, const NearestPoints& others,
                             const Eigen::Affine3f& placement, double most) {
    const Eigen::Index size = std::min(points, probes.cols());
    double sum = 0.0;
    for (Eigen::Index i = 0; i < size; ++i) {
      float squared;
      others.near(placement * probes.col(i), squared);
      sum += std::min<double>(std::sqrt(squared), most);
    }
    return sum / size;
  };
  const Eigen::Affine3f placement(pose.cast<float>());
  const double scale = scaleOf(pose);
  return mean(shapes_.source.simplified.points, *shapes_.target.all, placement, limit) +
         scale * mean(shapes_.target.simplified.points, *shapes_.source.all, placement.inverse(),
                      limit / scale);
}

} // namespace kss
} // namespace pcl
