/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "refinement/selection.h"

#include <pcl/registration/kss/detail/stopping.h>

#include "geometry/take.h"
#include "geometry/turns.h"
#include "refinement/overlap.h"
#include "support/parallel.h"
#include "surfaces/evidence.h"

#include <algorithm>
#include <cmath>

namespace pcl {
namespace kss {
namespace {

/** The poses, and each turned a little about each axis that it may be turned about. */
std::vector<Similarity>
withTurnedOnes(std::vector<Similarity> poses, const Turns& turns)
{
  for (std::size_t i = 0, n = poses.size(); i < n; ++i)
    for (Eigen::Index axis = 0; axis < turns.cols(); ++axis)
      for (const double angle : {-0.3, -0.15, 0.15, 0.3}) {
        Similarity turned = poses[i];
        turned.rotation *= Eigen::AngleAxisd(angle, Eigen::Vector3d(turns.col(axis)))
                               .toRotationMatrix();
        poses.push_back(turned);
      }
  return poses;
}

/** The mean distance of placed probes to points near them. */
double
truncatedMeanOf(const Points& probes,
                const NearestPoints& others,
                const Eigen::Affine3f& placement,
                Eigen::Index most,
                double limit)
{
  const Eigen::Index size = std::min(most, probes.cols());
  double sum = 0.0;
  for (Eigen::Index i = 0; i < size; ++i) {
    float squared;
    others.near(placement * probes.col(i), squared);
    sum += std::min<double>(std::sqrt(squared), limit);
  }
  return sum / size;
}

/** All points of a shape that take part, with normals. */
SurfacePoints
surfacePoints(const Shape& shape, bool is_dense)
{
  const auto& [surface, planes] = shape.surface;
  if (is_dense || shape.all == surface)
    return {surface, planes.normals};
  const Points& points = shape.all->points();
  SurfacePoints fewer{shape.all, Points(3, points.cols())};
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    float squared;
    fewer.normals.col(i) = planes.normals.col(surface->nearest(points.col(i), squared));
  }
  return fewer;
}

} // namespace

Selection::Selection(const ShapePair& shapes,
                     const SelectionEffort& effort,
                     unsigned int threads)
: shapes_(shapes)
, effort_(effort)
, threads_(threads)
, source_(surfacePoints(shapes.source, effort.is_dense))
, target_(surfacePoints(shapes.target, effort.is_dense))
, source_probes_(evenlySpaced(source_.points->points(), most_probes))
, target_probes_(evenlySpaced(target_.points->points(), most_probes))
{
}

std::vector<Similarity>
Selection::best(const std::vector<Similarity>& poses,
                const std::function<void(double)>& done) const
{
  std::vector<Ranked> ranked;
  for (const Similarity& pose : poses)
    ranked.push_back({pose, 0.0});
  try {
    refineMoreAndMore(ranked, done);
  }
  catch (const Stopped&) {
    // the best so far have to do
    ranked.resize(std::min(ranked.size(), most_alternatives));
  }
  std::vector<Similarity> best;
  for (const Ranked& candidate : ranked)
    best.push_back(candidate.pose);
  return best;
}

void
Selection::refineMoreAndMore(std::vector<Ranked>& ranked,
                             const std::function<void(double)>& done) const
{
  const Eigen::Index samples = shapes_.target.simplified.points.cols();
  for (const SelectionStep& step : stepsFromAfar(effort_, samples))
    ranked = refined(ranked, step);
  done(0.4);
  const double spacing =
      std::max(ranked.front().pose.scale * source_.points->usualSpacing(),
               static_cast<double>(target_.points->usualSpacing()));
  double share = 0.4;
  for (const SelectionStep& step :
       stepsOnSurfaces(effort_, spacing, samples, shapes_.is_noisy)) {
    ranked = refined(ranked, step);
    share += 0.5 * (1.0 - share);
    done(share);
  }
}

std::vector<Selection::Ranked>
Selection::refined(const std::vector<Ranked>& ranked, const SelectionStep& step) const
{
  std::vector<Similarity> poses;
  for (const Ranked& candidate : ranked)
    // a cost by overlap is a score with a minus
    if (poses.size() < step.most &&
        (!step.hope || candidate.cost <= *step.hope * ranked.front().cost))
      poses.push_back(candidate.pose);
  if (step.turned)
    poses = withTurnedOnes(poses, turnsOf(shapes_.axis));

  const Refinement refinement(
      step.on_clouds ? source_probes_ : shapes_.source.simplified.points,
      step.on_clouds ? target_probes_ : shapes_.target.simplified.points, source_,
      target_, shapes_.scales, shapes_.axis);
  std::vector<Ranked> all(poses.size());
  inParallel(poses.size(), threads_, 1, [&](std::ptrdiff_t i) {
    all[i].pose = refinement.refine(poses[i], step.effort);
    all[i].cost = costOf(all[i].pose, step);
  });
  std::stable_sort(all.begin(), all.end(),
                   [](const Ranked& a, const Ranked& b) { return a.cost < b.cost; });
  DistinctPoses distinct(shapes_.metric, step.distinct);
  std::vector<Ranked> kept;
  for (const Ranked& candidate : all)
    if (distinct.take(candidate.pose))
      kept.push_back(candidate);
  return kept;
}

double
Selection::costOf(const Similarity& pose, const SelectionStep& step) const
{
  if (step.cost == PoseCost::DISTANCE)
    return truncatedMean(pose, step.cost_probes, step.limit);
  const Overlap overlap =
      overlapAt(*source_.points, *target_.points, pose, step.cost_probes);
  if (step.cost == PoseCost::OVERLAP)
    return -overlap.score;
  return -logOddsOf(
      {{},
       overlap,
       evidenceAt(shapes_.source.surface, shapes_.target.surface, pose,
                  shapes_.scales.smallest < shapes_.scales.largest, step.cost_probes)});
}

double
Selection::truncatedMean(const Similarity& pose,
                         Eigen::Index points,
                         double limit) const
{
  const Eigen::Affine3f placement = pose.affine();
  return truncatedMeanOf(shapes_.source.simplified.points, *target_.points, placement,
                         points, limit) +
         pose.scale * truncatedMeanOf(shapes_.target.simplified.points, *source_.points,
                                      placement.inverse(), points, limit / pose.scale);
}

} // namespace kss
} // namespace pcl
