/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "candidates/sweeps.h"

#include "candidates/numbers.h"
#include "geometry/clouds.h"

#include <algorithm>
#include <cmath>

namespace pcl {
namespace kss {
namespace {

using namespace search_numbers;

/** Powers of the step from the range, and 1 or what is nearest to it. */
std::vector<double>
scalesIn(const ScaleRange& range)
{
  std::vector<double> scales;
  for (int i = -scale_steps; i <= scale_steps; ++i) {
    const double scale = std::pow(scale_step, i);
    // rounding aside
    if (scale >= 0.9999 * range.smallest && scale <= 1.0001 * range.largest)
      scales.push_back(scale);
  }
  if (scales.empty())
    scales.push_back(range.clamp(1.0));
  return scales;
}

/** What the sweeps of a pair of clouds have in common. */
class SweepMaker {
public:
  SweepMaker(const Settings& settings,
             const Points& source,
             const Points& target,
             const ScaleRange& scales,
             const Grain& grain)
  : settings_(settings)
  , source_(source)
  , target_(target)
  , scales_(scales)
  , grain_(grain)
  , rotations_(candidateRotations(settings))
  {
  }

  /** Both clouds are complete: (e10). */
  std::vector<Sweep>
  global() const
  {
    return {{Candidates(rotations_, {scales_.clamp(1.0)}, ownCenter(), Role::TARGET),
             {both}}};
  }

  /** The source is a part of the target, or the target of the source: (e13). */
  std::vector<Sweep>
  partOfWhole() const
  {
    const ScaleRange smaller{scales_.smallest, scales_.clamp(1.0)};
    const ScaleRange larger{scales_.clamp(1.0), scales_.largest};
    // Centres of the cloud that the energy is directed to suit the screening; the paper
    // replaces the centre of the incomplete cloud.
    if (settings_.center_set == CenterSet::PAPER)
      return {onSource(smaller, of_a_part, {fromSource()}),
              onTarget(larger, of_a_part, {fromTarget()})};
    return {onTarget(smaller, of_a_part, {fromSource()}),
            onSource(larger, of_a_part, {fromTarget()})};
  }

  /** Both clouds lack parts.
   * \param[in] or_a_part whether one of them may be complete nevertheless
   */
  std::vector<Sweep>
  twoParts(bool or_a_part) const
  {
    // Unknown scales make the search so much longer that one cloud is then expected to
    // be nearly complete, if it may be.
    CenterGrid on_source = scales_.smallest == scales_.largest || !or_a_part
                               ? grain_.two_parts
                               : of_a_part;
    CenterGrid on_target = on_source;
    // the larger cloud sets how far its centre can be away
    const double ratio = sizeRatio();
    on_target.reach *= std::max(1.0, ratio);
    on_source.reach *= std::max(1.0, 1.0 / ratio);
    // A part is smaller than the whole, its pre-shape too large: what is turned upon
    // the other cloud has to shrink, and one step more if the other is a part, too.
    const ScaleRange shrunk{scales_.smallest, scales_.clamp(scale_step)};
    const ScaleRange grown{scales_.clamp(1.0 / scale_step), scales_.largest};
    if (!or_a_part)
      return {onTarget(shrunk, on_target, {both}), onSource(grown, on_source, {both})};
    return {onTarget(shrunk, on_target, {both, fromSource()}),
            onSource(grown, on_source, {both, fromTarget()})};
  }

  /** The smaller cloud lies anywhere in the larger one, among other things. */
  std::vector<Sweep>
  inScene() const
  {
    constexpr Weights from_source{1.0f, 0.0f}, from_target{0.0f, 1.0f};
    if (sizeRatio() <= 1.0)
      return {onTarget(scales_, grain_.two_parts, {from_source})};
    return {onSource(scales_, grain_.two_parts, {from_target})};
  }

private:
  static constexpr Weights both{1.0f, 1.0f};

  /** How much larger the source is than the target. */
  double
  sizeRatio() const
  {
    return rootMeanSquareRadius(source_, Eigen::Vector3f::Zero()) /
           rootMeanSquareRadius(target_, Eigen::Vector3f::Zero());
  }

  float
  other() const
  {
    return isOfLargest(settings_.energy) ? 0.0f : weight_of_other_direction;
  }

  Weights
  fromSource() const
  {
    return {1.0f, other()};
  }

  Weights
  fromTarget() const
  {
    return {other(), 1.0f};
  }

  Sweep
  onSource(const ScaleRange& range,
           const CenterGrid& centers,
           const std::vector<Weights>& energies) const
  {
    return {Candidates(rotations_, scalesOf(range), centersOf(source_, centers),
                       Role::SOURCE),
            energies};
  }

  Sweep
  onTarget(const ScaleRange& range,
           const CenterGrid& centers,
           const std::vector<Weights>& energies) const
  {
    return {Candidates(rotations_, scalesOf(range), centersOf(target_, centers),
                       Role::TARGET),
            energies};
  }

  CandidateCenters
  centersOf(const Points& cloud, const CenterGrid& centers) const
  {
    return settings_.center_set == CenterSet::PAPER
               ? paperCenters(cloud)
               : spreadCenters(cloud, centers.reach, centers.step, mostCenters());
  }

  double
  mostCenters() const
  {
    return std::clamp(grain_.most_candidates /
                          static_cast<double>(rotations_->rotations().size()),
                      1.0, most_centers);
  }

  /** The paper knows no scale but that of the pre-shapes. */
  std::vector<double>
  scalesOf(const ScaleRange& range) const
  {
    return settings_.center_set == CenterSet::PAPER
               ? std::vector<double>{scales_.clamp(1.0)}
               : scalesIn(range);
  }

  const Settings& settings_;
  const Points &source_, &target_;
  const ScaleRange& scales_;
  const Grain& grain_;
  std::shared_ptr<const CandidateRotations> rotations_;
};

} // namespace

std::vector<Sweep>
sweepsOf(const Settings& settings,
         const Points& source,
         const Points& target,
         const ScaleRange& scales,
         const Grain& grain)
{
  const SweepMaker sweeps(settings, source, target, scales, grain);
  if (grain.in_scene)
    return sweeps.inScene();
  switch (settings.mode) {
  case Mode::GLOBAL_GLOBAL:
    return sweeps.global();
  case Mode::PARTIAL_GLOBAL:
    return sweeps.partOfWhole();
  case Mode::PARTIAL_PARTIAL:
    return sweeps.twoParts(false);
  case Mode::IN_SCENE:
  case Mode::AUTOMATIC:
    break;
  }
  return sweeps.twoParts(true);
}

} // namespace kss
} // namespace pcl
