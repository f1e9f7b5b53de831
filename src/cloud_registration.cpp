/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include <pcl/registration/kss/cloud_registration.h>

#include <pcl/registration/kss/alignment.h>
#include <pcl/registration/kss/detail/copies.h>
#include <pcl/registration/kss/detail/final_stage.h>
#include <pcl/registration/kss/detail/misfit.h>
#include <pcl/registration/kss/detail/naming.h>
#include <pcl/registration/kss/detail/similarity.h>
#include <pcl/registration/kss/detail/stopping.h>
#include <pcl/registration/kss/detail/usable_points.h>

#include "final/cloud_icp.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <stdexcept>

namespace pcl {
namespace kss {
namespace {

using Index = std::int32_t;

auto
placesOf(const Cloud& cloud)
{
  return [&cloud](Index i) { return cloud.points.col(i); };
}

/** The indices of so many points. */
std::vector<Index>
allIndices(Eigen::Index size)
{
  std::vector<Index> all(size);
  std::iota(all.begin(), all.end(), 0);
  return all;
}

UsablePoints<Index>
usablePointsOf(const char* name, const Cloud& cloud)
{
  return naming(name, [&] {
    if (cloud.points.cols() > std::numeric_limits<Index>::max())
      throw std::invalid_argument("it has more than 2^31 points");
    if (cloud.normals.cols() != 0 && cloud.normals.cols() != cloud.points.cols())
      throw std::invalid_argument("it has " + std::to_string(cloud.points.cols()) +
                                  " points and " +
                                  std::to_string(cloud.normals.cols()) + " normals");
    return usablePoints(placesOf(cloud), allIndices(cloud.points.cols()));
  });
}

LocalCloud
toLocalCloud(const Cloud& cloud, const UsablePoints<Index>& usable)
{
  LocalCloud local = localCloud(placesOf(cloud), usable);
  if (cloud.normals.cols() > 0)
    local.normals =
        unitNormals([&cloud](Index i) { return cloud.normals.col(i); }, usable.indices);
  return local;
}

/** Points of the source that take part in the final ICP, sorted in space. */
Eigen::Matrix3Xd
finalPoints(const Cloud& source, const UsablePoints<Index>& usable, std::size_t most)
{
  std::vector<Index> used = spread(usable.indices, most);
  sortInSpace(
      [&](Index i) -> Eigen::Vector3d {
        return source.points.col(i) - usable.bulk.middle;
      },
      used);
  Eigen::Matrix3Xd points(3, used.size());
  for (std::size_t i = 0; i < used.size(); ++i)
    points.col(i) = source.points.col(used[i]);
  return points;
}

/** How far floats in the frame of a cloud are off. */
double
roundingErrorOf(const LocalCloud& cloud)
{
  return std::sqrt(roundingError([&](Index i) { return cloud.points.col(i); },
                                 allIndices(cloud.points.cols())));
}

/** The mirror image of a cloud, at a scale. */
Cloud
mirrored(const Cloud& cloud, int axis, double scale)
{
  Cloud image = cloud;
  image.points *= scale;
  image.points.row(axis) *= -1.0;
  image.normals.row(axis) *= -1.0f;
  return image;
}

} // namespace

struct CloudRegistration::Implementation {
  Settings settings;
  int iterations = 300;
  StopSignal stop;
  std::unique_ptr<Alignment> alignment; ///< keeps what the next align() can use

  /** The alignment stage for settings: that of the last time, which has kept what it
   * made of the clouds, where they ask for the same work. */
  Alignment&
  alignmentFor(const Settings& asked)
  {
    if (!alignment || !sameWork(alignment->settings(), asked))
      alignment = std::make_unique<Alignment>(asked);
    return *alignment;
  }

  /** Algorithm 1; throws where no pose can be found.
   * \param[in] explains_misfits whether to say what would fit where nothing does
   */
  void
  registerClouds(const Settings& asked,
                 const Cloud& source,
                 const Cloud& target,
                 const std::optional<StoredPose>& guess,
                 bool explains_misfits,
                 Stages& stages,
                 Registered& result)
  {
    if (guess && !isSimilarity(*guess))
      throw std::invalid_argument(
          "The guess is not a rotation, translation and positive scale.");
    const auto source_points = usablePointsOf("source", source);
    const auto target_points = usablePointsOf("target", target);
    result.far_points = {source_points.far, target_points.far};
    if (guess && !target_points.bulk.holds(
                     (*guess * source_points.bulk.middle.homogeneous()).head<3>()))
      throw std::invalid_argument(
          "The guess takes the source far away from the target: "
          "is it in the units of the clouds?");
    std::optional<double> guessed_scale;
    if (guess)
      guessed_scale = scaleOf(*guess);

    const LocalCloud local_target = toLocalCloud(target, target_points);

    // a handful of points has no surface, but may be a copy
    if (source_points.indices.size() <= most_points_of_copies)
      result.alternatives =
          copiesOf(toLocalCloud(source, source_points), local_target, asked, guess);
    if (!result.alternatives.empty()) {
      result.transformation = result.alternatives.front().transformation;
      result.mode = Mode::GLOBAL_GLOBAL;
      FinalRun at_rest;
      at_rest.converged = true;
      result.failure = failureOf(asked, result.alternatives, &at_rest, "", {});
      return;
    }

    // simplification, pre-shapes, {C} x {O}, energies, minima, ICP on each
    Alignment& alignment_stage = alignmentFor(asked);
    const Aligned aligned = alignment_stage.align(toLocalCloud(source, source_points),
                                                  local_target, guessed_scale, stages);
    result.device = alignment_stage.deviceName();

    // ICP on the clouds themselves, (e11), and the choice among the poses
    stages.begin("final ICP");
    const Eigen::Matrix3Xd used = finalPoints(source, source_points, asked.icp_points);
    FinalClouds clouds;
    clouds.points = used.cols();
    clouds.iterations = iterations;
    clouds.rounding_error = roundingErrorOf(local_target);
    clouds.source_centroid = centroidOf(placesOf(source), source_points.indices);
    CloudICP icp(aligned.scorer, used, local_target, clouds.source_centroid,
                 clouds.rounding_error);
    FinalStage final_stage(asked, aligned.scorer, clouds, icp, stages);
    const std::vector<FinalContender> contenders =
        final_stage.settle(aligned.alternatives, guess);
    const FinalRun* const run = contenders.front().run.get();
    result.transformation = contenders.front().alternative.transformation;
    if (run) {
      result.precision = run->precision;
      result.iterations = run->iterations;
    }
    result.alternatives = distinctPoses(contenders, aligned.scorer);
    result.mode = asked.mode == Mode::AUTOMATIC
                      ? modeOf(result.alternatives.front().overlap)
                      : asked.mode;
    stages.end();

    const double given_scale = guessed_scale.value_or(1.0);
    const auto what_would_fit = [&] {
      return whatWouldFit(
          asked, result.alternatives.front().overlap, given_scale,
          target_points.bulk.radius / source_points.bulk.radius,
          [&](Mirror mirror, const Settings& otherwise) {
            return mirror ? scaleOfFit(otherwise,
                                       mirrored(source, *mirror, given_scale), target)
                          : scaleOfFit(otherwise, source, target);
          });
    };
    result.failure =
        failureOf(asked, result.alternatives, run, final_stage.stopped(),
                  explains_misfits ? what_would_fit : std::function<std::string()>());
  }

  /** The scale at which two clouds fit, if they do. */
  std::optional<double>
  scaleOfFit(Settings asked, const Cloud& source, const Cloud& target)
  try {
    asked.progress = {};
    // what is known of the target; dropped with the other where that fails
    Implementation other;
    other.iterations = iterations;
    if (alignment && sameWork(alignment->settings(), asked))
      other.alignment = std::move(alignment);
    Stages stages;
    Registered result;
    other.registerClouds(asked, source, target, {}, false, stages, result);
    if (other.alignment && sameWork(other.alignment->settings(), settings))
      alignment = std::move(other.alignment);
    if (result.failure.cause != FailureCause::NONE)
      return {};
    return scaleOf(result.transformation);
  }
  catch (const std::exception&) {
    return {}; // it determines no pose, or has to end
  }
};

CloudRegistration::CloudRegistration(const Settings& settings)
: implementation_(std::make_unique<Implementation>())
{
  implementation_->settings = checked(settings, Settings()).settings;
}

CloudRegistration::~CloudRegistration() = default;

void
CloudRegistration::setMaximumIterations(int iterations)
{
  implementation_->iterations = std::max(1, iterations);
}

Registered
CloudRegistration::align(const Cloud& source,
                         const Cloud& target,
                         const std::optional<StoredPose>& guess)
{
  Implementation& own = *implementation_;
  own.stop.restart(own.settings.time_limit);
  const HeedingSignal heeding(&own.stop);
  Registered result;
  Stages stages;
  try {
    stages.restart(own.settings.progress);
    own.registerClouds(own.settings, source, target, guess, true, stages, result);
  }
  catch (...) {
    result = {};
    result.failure = failureOfException();
    if (guess && isSimilarity(*guess))
      result.transformation = *guess;
    own.alignment.reset(); // whatever it was in the midst of
  }
  result.seconds = stages.seconds();
  return result;
}

void
CloudRegistration::cancel() noexcept
{
  implementation_->stop.cancel();
}

} // namespace kss
} // namespace pcl
