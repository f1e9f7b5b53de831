/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include <pcl/registration/kss/detail/surface_steps.h>

#include "geometry/turns.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace pcl {
namespace kss {
namespace {

/** Steps whose contraction is averaged: chance makes single ones longer or shorter. */
constexpr std::size_t late_steps = 4;

/** Beyond, steps hardly end. */
constexpr double strongest_contraction = 0.8;

} // namespace

struct SurfaceSteps::Implementation {
  std::optional<PoseScorer> scorer; ///< none: there are no clouds
  Eigen::Matrix3Xd source_normals;
  Points target_normals;      ///< where they are known
  std::vector<bool> is_known; ///< of those of the target
  SurfaceStepSettings settings;
  Eigen::Matrix3d linear = Eigen::Matrix3d::Identity(); ///< of the pose so far
  SurfacePairs pairs;                                   ///< of the last step
  SurfaceStep last;
  std::vector<double> moves; ///< squared, of all steps of the run

  /** Learn the normals of the matched points of the target. */
  void
  lookUp(const Matches& matches)
  {
    std::vector<std::size_t> unknown;
    for (std::size_t i = 0; i < matches.matches.size(); ++i)
      if (!is_known[matches.matches[i]]) {
        is_known[matches.matches[i]] = true;
        unknown.push_back(i);
      }
    Eigen::Matrix3Xd places(3, unknown.size());
    for (std::size_t i = 0; i < unknown.size(); ++i)
      places.col(i) = matches.target.col(unknown[i]);
    Points normals(3, unknown.size());
    scorer->targetNormals(places, normals);
    for (std::size_t i = 0; i < unknown.size(); ++i)
      target_normals.col(matches.matches[unknown[i]]) = normals.col(i);
  }

  void
  makePairs(const Matches& matches)
  {
    lookUp(matches);
    const Eigen::Matrix3d rotation = linear / std::cbrt(linear.determinant());
    const Eigen::Index size = matches.source.cols();
    pairs.source = matches.source;
    pairs.target = matches.target;
    pairs.source_normals.resize(3, size);
    pairs.target_normals.resize(3, size);
    for (Eigen::Index i = 0; i < size; ++i) {
      pairs.source_normals.col(i) = rotation * source_normals.col(matches.queries[i]);
      pairs.target_normals.col(i) =
          target_normals.col(matches.matches[i]).cast<double>();
    }
  }

  /** By how much steps have become shorter from one to the next, of late. */
  double
  contraction() const
  {
    const std::size_t steps = std::min(moves.size() - 1, late_steps);
    if (steps == 0 || !(moves.back() > 0.0))
      return 0.0;
    const double all = moves.back() / moves[moves.size() - 1 - steps];
    return std::min(strongest_contraction, std::pow(all, 0.5 / steps));
  }
};

SurfaceSteps::SurfaceSteps()
: implementation_(std::make_unique<Implementation>())
{
}

SurfaceSteps::~SurfaceSteps() = default;

void
SurfaceSteps::setClouds(const PoseScorer& scorer,
                        const Eigen::Matrix3Xd& source,
                        std::size_t target_size)
{
  auto& [own_scorer, source_normals, target_normals, is_known, settings, linear, pairs,
         last, moves] = *implementation_;
  own_scorer = scorer;
  Points normals(3, source.cols());
  scorer.sourceNormals(source, normals);
  source_normals = normals.cast<double>();
  if (is_known.size() != target_size) {
    target_normals.resize(3, target_size);
    is_known.assign(target_size, false);
  }
}

bool
SurfaceSteps::haveClouds() const
{
  return implementation_->scorer.has_value();
}

void
SurfaceSteps::forgetClouds()
{
  *implementation_ = {};
}

void
SurfaceSteps::start(const Eigen::Matrix4d& pose,
                    const SurfaceStepSettings& settings,
                    bool goes_on)
{
  const double contraction = implementation_->settings.contraction;
  implementation_->settings = settings;
  implementation_->linear = pose.topLeftCorner<3, 3>();
  implementation_->last = {};
  if (goes_on)
    implementation_->settings.contraction = contraction;
  else
    implementation_->moves.clear();
}

const SurfaceStep&
SurfaceSteps::step(const Matches& matches)
{
  Implementation& run = *implementation_;
  SurfaceStepSettings left = run.settings;
  if (left.smallest_scale < left.largest_scale) {
    const double scale = std::cbrt(run.linear.determinant());
    left.smallest_scale /= scale;
    left.largest_scale /= scale;
  }
  run.makePairs(matches);
  run.last = surfaceStep(run.pairs, left);
  run.moves.push_back(run.last.squared_errors_moved);
  run.settings.contraction = run.contraction();
  if (run.last.is_found)
    run.linear = run.last.transformation.topLeftCorner<3, 3>() * run.linear;
  return run.last;
}

StoredPose
SurfaceSteps::taken(const StoredPose& transformation, const Matches& matches)
{
  Implementation& run = *implementation_;
  const StoredPose step = turnedAbout(run.settings.rotation_axis, transformation,
                                      matches.source.rowwise().mean());
  run.linear = step.topLeftCorner<3, 3>() * run.linear;
  return step;
}

const SurfaceStep&
SurfaceSteps::last() const
{
  return implementation_->last;
}

SurfacePrecision
SurfaceSteps::precision(const Eigen::Vector3d& center) const
{
  return implementation_->last.is_found
             ? surfacePrecision(implementation_->pairs, implementation_->settings,
                                center)
             : SurfacePrecision();
}

} // namespace kss
} // namespace pcl
