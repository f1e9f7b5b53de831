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
#include "prepared_scan.h"

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

/** What the final ICP asks of a source. */
void
fillAsSource(const Cloud& cloud,
             const UsablePoints<Index>& usable,
             const Settings& settings,
             PreparedScan& scan)
{
  scan.used = finalPoints(cloud, usable, settings.icp_points);
  scan.centroid = centroidOf(placesOf(cloud), usable.indices);
}

/** What the final ICP asks of a target. */
void
fillAsTarget(PreparedScan& scan)
{
  scan.rounding_error = roundingErrorOf(scan.local);
  scan.tree = std::make_shared<PackedTree>(scan.local.points.data(), 3,
                                           scan.local.points.cols());
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

FinalClouds
finalCloudsOf(const PreparedScan& source, const PreparedScan& target, int iterations)
{
  FinalClouds clouds;
  clouds.points = source.used.cols();
  clouds.iterations = iterations;
  clouds.rounding_error = target.rounding_error;
  clouds.source_centroid = source.centroid;
  return clouds;
}

void
throwIfNoSimilarity(const std::optional<StoredPose>& guess)
{
  if (guess && !isSimilarity(*guess))
    throw std::invalid_argument(
        "The guess is not a rotation, translation and positive scale.");
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
    throwIfNoSimilarity(guess);
    const auto source_points = usablePointsOf("source", source);
    const auto target_points = usablePointsOf("target", target);
    PreparedScan source_scan, target_scan;
    source_scan.bulk = source_points.bulk;
    source_scan.far = source_points.far;
    target_scan.bulk = target_points.bulk;
    target_scan.far = target_points.far;
    target_scan.local = toLocalCloud(target, target_points);
    source_scan.local = toLocalCloud(source, source_points);
    const auto guessed_scale = checkedScale(source_scan, target_scan, guess, result);
    if (areCopies(asked, source_scan, target_scan, guess, result))
      return;

    // simplification, pre-shapes, {C} x {O}, energies, minima, ICP on each
    Alignment& stage = alignmentFor(asked);
    const Aligned aligned =
        stage.align(source_scan.local, target_scan.local, guessed_scale, stages);
    result.device = stage.deviceName();
    fillAsSource(source, source_points, asked, source_scan);
    fillAsTarget(target_scan);
    const FinalOutcome outcome =
        settle(asked, aligned, source_scan, target_scan, guess, stages, result);

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
        failureOf(asked, result.alternatives, outcome.run.get(), outcome.stopped,
                  explains_misfits ? what_would_fit : std::function<std::string()>());
  }

  /** The same for clouds that have been made ready, without a guess; does not say what
   * would fit where nothing does. */
  void
  registerScans(const PreparedScan& source,
                const PreparedScan& target,
                Thoroughness thoroughness,
                Stages& stages,
                Registered& result)
  {
    result.far_points = {source.far, target.far};
    if (areCopies(settings, source, target, {}, result))
      return;
    Alignment& stage = alignmentFor(settings);
    const Aligned aligned =
        stage.align(source.prepared, target.prepared, {}, thoroughness, stages);
    result.device = stage.deviceName();
    const FinalOutcome outcome =
        settle(settings, aligned, source, target, {}, stages, result);
    result.failure = failureOf(settings, result.alternatives, outcome.run.get(),
                               outcome.stopped, {});
  }

  /** The scale of a guess, which must not lead away from the target. */
  static std::optional<double>
  checkedScale(const PreparedScan& source,
               const PreparedScan& target,
               const std::optional<StoredPose>& guess,
               Registered& result)
  {
    result.far_points = {source.far, target.far};
    if (guess &&
        !target.bulk.holds((*guess * source.bulk.middle.homogeneous()).head<3>()))
      throw std::invalid_argument(
          "The guess takes the source far away from the target: "
          "is it in the units of the clouds?");
    if (!guess)
      return {};
    return scaleOf(*guess);
  }

  /** A handful of points has no surface, but may be a copy. */
  static bool
  areCopies(const Settings& asked,
            const PreparedScan& source,
            const PreparedScan& target,
            const std::optional<StoredPose>& guess,
            Registered& result)
  {
    if (source.local.points.cols() <= static_cast<Eigen::Index>(most_points_of_copies))
      result.alternatives = copiesOf(source.local, target.local, asked, guess);
    if (result.alternatives.empty())
      return false;
    result.transformation = result.alternatives.front().transformation;
    result.mode = Mode::GLOBAL_GLOBAL;
    FinalRun at_rest;
    at_rest.converged = true;
    result.failure = failureOf(asked, result.alternatives, &at_rest, "", {});
    return true;
  }

  /** What the final ICP leaves beside poses. */
  struct FinalOutcome {
    std::shared_ptr<const FinalRun> run; ///< of the result; null: none
    std::string stopped;
  };

  /** ICP on the clouds themselves, (e11), and the choice among the poses. */
  FinalOutcome
  settle(const Settings& asked,
         const Aligned& aligned,
         const PreparedScan& source,
         const PreparedScan& target,
         const std::optional<StoredPose>& guess,
         Stages& stages,
         Registered& result)
  {
    stages.begin("final ICP");
    const FinalClouds clouds = finalCloudsOf(source, target, iterations);
    CloudICP icp(aligned.scorer, source.used, target.local, *target.tree,
                 clouds.source_centroid, clouds.rounding_error);
    FinalStage final_stage(asked, aligned.scorer, clouds, icp, stages);
    const std::vector<FinalContender> contenders =
        final_stage.settle(aligned.alternatives, guess);
    const std::shared_ptr<const FinalRun> run = contenders.front().run;
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
    return {run, final_stage.stopped()};
  }

  /** What a registration comes to, whatever it throws. */
  template <typename Work>
  Registered
  guarded(const std::optional<StoredPose>& guess, const Work& work)
  {
    stop.restart(settings.time_limit);
    const HeedingSignal heeding(&stop);
    Registered result;
    Stages stages;
    try {
      stages.restart(settings.progress);
      work(stages, result);
    }
    catch (...) {
      result = {};
      result.failure = failureOfException();
      if (guess && isSimilarity(*guess))
        result.transformation = *guess;
      alignment.reset(); // whatever it was in the midst of
    }
    result.seconds = stages.seconds();
    return result;
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
  return implementation_->guarded(guess, [&](Stages& stages, Registered& result) {
    implementation_->registerClouds(implementation_->settings, source, target, guess,
                                    true, stages, result);
  });
}

std::shared_ptr<const PreparedScan>
CloudRegistration::prepared(const Cloud& cloud)
{
  const auto usable = usablePointsOf("scan", cloud);
  const auto scan = std::make_shared<PreparedScan>();
  scan->bulk = usable.bulk;
  scan->far = usable.far;
  scan->local = toLocalCloud(cloud, usable);
  fillAsSource(cloud, usable, implementation_->settings, *scan);
  fillAsTarget(*scan);
  scan->prepared =
      implementation_->alignmentFor(implementation_->settings).prepared(scan->local);
  return scan;
}

Registered
CloudRegistration::align(const PreparedScan& source,
                         const PreparedScan& target,
                         Thoroughness thoroughness)
{
  return implementation_->guarded({}, [&](Stages& stages, Registered& result) {
    implementation_->registerScans(source, target, thoroughness, stages, result);
  });
}

Registered
CloudRegistration::step(const PreparedScan& source,
                        const PreparedScan& target,
                        const StoredPose& pose)
{
  return implementation_->guarded(pose, [&](Stages& stages, Registered& result) {
    const Settings& settings = implementation_->settings;
    const PoseScorer scorer = implementation_->alignmentFor(settings).scorerOf(
        source.prepared, target.prepared, scaleOf(pose));
    const FinalClouds clouds = finalCloudsOf(source, target, 1);
    CloudICP icp(scorer, source.used, target.local, *target.tree,
                 clouds.source_centroid, clouds.rounding_error);
    const FinalRun run =
        FinalStage(settings, scorer, clouds, icp, stages).stepFrom(pose);
    result.transformation = run.transformation;
    result.precision = run.precision;
    result.iterations = run.iterations;
  });
}

void
CloudRegistration::cancel() noexcept
{
  implementation_->stop.cancel();
}

} // namespace kss
} // namespace pcl
