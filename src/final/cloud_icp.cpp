/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "final/cloud_icp.h"

#include <pcl/registration/kss/detail/similarity.h>
#include <pcl/registration/kss/detail/stopping.h>
#include <pcl/registration/kss/detail/usable_points.h>

#include <Eigen/Geometry>

#include <cmath>
#include <limits>
#include <numeric>

namespace pcl {
namespace kss {
namespace {

/** A pose takes three pairs. */
constexpr std::size_t fewest_pairs = 3;

/** A relative change of the mean squared error below this is none. */
constexpr double least_change = 1e-5;

/** So many of the points, spread over them. */
Eigen::Matrix3Xd
some(const Eigen::Matrix3Xd& points, std::size_t most)
{
  std::vector<Eigen::Index> all(points.cols());
  std::iota(all.begin(), all.end(), Eigen::Index(0));
  const std::vector<Eigen::Index> chosen = spread(all, most);
  Eigen::Matrix3Xd few(3, chosen.size());
  for (std::size_t i = 0; i < chosen.size(); ++i)
    few.col(i) = points.col(chosen[i]);
  return few;
}

} // namespace

CloudICP::CloudICP(const PoseScorer& scorer,
                   const Eigen::Matrix3Xd& source,
                   const LocalCloud& target,
                   const PackedTree& tree,
                   const Eigen::Vector3d& centroid,
                   double rounding_error)
: scorer_(scorer)
, target_(target)
, tree_(tree)
, centroid_(centroid)
, rounding_error_(rounding_error)
, all_(source)
, few_(some(source, points_of_first_steps))
{
}

bool
CloudICP::iterate(const FinalStep& step,
                  const FinalStepSettings& settings,
                  StoredPose& pose,
                  int& iterations)
{
  const Eigen::Matrix3Xd& points = step.has_all_points ? all_ : few_;
  if (source_ != &points) {
    source_ = &points;
    tracked_.assign(points.cols(), {});
    steps_.setClouds(scorer_, points, target_.points.cols());
  }
  steps_.start(pose, settings.surfaces, settings.goes_on);
  iterations = 0;
  last_ = {};
  last_.transformation = pose;
  double before = std::numeric_limits<double>::max();
  while (!last_.converged && iterations < step.iterations) {
    const double squared_error = match(pose, settings.reach);
    last_.has_too_few_pairs = matches_.queries.size() < fewest_pairs;
    if (last_.has_too_few_pairs)
      return true; // where it is
    const Eigen::Matrix4d moved = nextStep();
    pose = moved * pose;
    if (!isSimilarity(pose))
      return false;
    last_.transformation = pose;
    settings.made(++iterations);
    throwIfStopped();
    // at the limit, clouds that moved by less than a standard error are at rest, too
    const double most = iterations < step.iterations ? at_rest * at_rest : 1.0;
    const SurfaceStep& surfaces = steps_.last();
    last_.converged =
        moved.isIdentity(0.0) ||
        (surfaces.is_found && surfaces.squared_errors_moved < most) ||
        squared_error <= rounding_error_ * rounding_error_ ||
        (iterations > 1 && std::abs(squared_error - before) < least_change * before);
    before = squared_error;
  }
  return true;
}

double
CloudICP::match(const StoredPose& pose, double reach)
{
  const Eigen::Matrix3d linear = pose.topLeftCorner<3, 3>();
  const Eigen::Vector3d shift = pose.topRightCorner<3, 1>();
  const double most = reach * reach;
  const auto limit = static_cast<float>(looked_beyond * reach);
  matches_.queries.clear();
  matches_.matches.clear();
  matches_.source.resize(3, source_->cols());
  matches_.target.resize(3, source_->cols());
  double squared_error = 0.0;
  for (Eigen::Index i = 0; i < source_->cols(); ++i) {
    if (i % 4096 == 0)
      throwIfStopped();
    const Eigen::Vector3d placed = linear * source_->col(i) + shift;
    const Eigen::Vector3f place = (placed - target_.origin).cast<float>();
    TrackedPoint& tracked = tracked_[i];
    const float squared = tracked.move(
        place, limit,
        [&](std::int32_t target) {
          return (target_.points.col(target) - place).squaredNorm();
        },
        [&](float squared_limit) {
          return tree_.nearest(place.data(), squared_limit);
        });
    if (tracked.nearest() < 0 || squared > most)
      continue;
    const auto pair = static_cast<Eigen::Index>(matches_.queries.size());
    matches_.source.col(pair) = placed;
    matches_.target.col(pair) =
        target_.origin + target_.points.col(tracked.nearest()).cast<double>();
    matches_.queries.push_back(static_cast<std::int32_t>(i));
    matches_.matches.push_back(tracked.nearest());
    squared_error += squared;
  }
  const auto pairs = static_cast<Eigen::Index>(matches_.queries.size());
  matches_.source.conservativeResize(3, pairs);
  matches_.target.conservativeResize(3, pairs);
  return squared_error / static_cast<double>(pairs);
}

Eigen::Matrix4d
CloudICP::nextStep()
{
  const SurfaceStep& step = steps_.step(matches_);
  if (step.is_found)
    return step.transformation;
  // no surfaces: S. Umeyama, "Least-squares estimation of transformation parameters
  // between two point patterns", 1991
  return steps_.taken(Eigen::umeyama(matches_.source, matches_.target, false),
                      matches_);
}

std::shared_ptr<FinalRun>
CloudICP::lastRun(bool is_pose)
{
  const auto run = std::make_shared<FinalRun>(last_);
  if (is_pose)
    run->precision =
        steps_.precision((last_.transformation * centroid_.homogeneous()).head<3>());
  return run;
}

} // namespace kss
} // namespace pcl
