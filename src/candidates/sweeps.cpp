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

} // namespace

std::vector<Sweep>
sweepsOf(const Settings& settings,
         const Points& source,
         const Points& target,
         const ScaleRange& scales)
{
  const std::shared_ptr<const CandidateRotations> rotations =
      candidateRotations(settings);
  const float other = settings.energy == Energy::HAUSDORFF ? 0.0f : neutral;
  const Weights both{1.0f, 1.0f}, from_source{1.0f, other}, from_target{other, 1.0f};
  const auto centersOf = [&](const Points& cloud, const CenterGrid& centers) {
    return settings.center_set == CenterSet::PAPER
               ? paperCenters(cloud)
               : spreadCenters(cloud, centers.reach, centers.step);
  };
  // the paper knows no scale but that of the pre-shapes
  const auto scalesOf = [&](const ScaleRange& range) {
    return settings.center_set == CenterSet::PAPER
               ? std::vector<double>{scales.clamp(1.0)}
               : scalesIn(range);
  };
  const ScaleRange smaller{scales.smallest, scales.clamp(1.0)};
  const ScaleRange larger{scales.clamp(1.0), scales.largest};

  // Centres of the cloud that the energy is directed to suit the screening; the paper
  // replaces the centre of the incomplete cloud.
  const auto onSource = [&](const ScaleRange& range, const CenterGrid& centers,
                            const std::vector<Weights>& energies) -> Sweep {
    return {Candidates(rotations, scalesOf(range), centersOf(source, centers),
                       Role::SOURCE),
            energies};
  };
  const auto onTarget = [&](const ScaleRange& range, const CenterGrid& centers,
                            const std::vector<Weights>& energies) -> Sweep {
    return {Candidates(rotations, scalesOf(range), centersOf(target, centers),
                       Role::TARGET),
            energies};
  };

  switch (settings.mode) {
  case Mode::GLOBAL_GLOBAL:
    return {{Candidates(rotations, {scales.clamp(1.0)}, ownCenter(), Role::TARGET),
             {both}}};
  case Mode::PARTIAL_GLOBAL:
    if (settings.center_set == CenterSet::PAPER)
      return {onSource(smaller, of_a_part, {from_source}),
              onTarget(larger, of_a_part, {from_target})};
    return {onTarget(smaller, of_a_part, {from_source}),
            onSource(larger, of_a_part, {from_target})};
  default:
    break;
  }
  // Unknown scales make the search so much longer that AUTOMATIC then expects one cloud
  // to be nearly complete. The larger cloud sets how far its centre can be away.
  const CenterGrid centers =
      scales.smallest == scales.largest || settings.mode == Mode::PARTIAL_PARTIAL
          ? of_two_parts
          : of_a_part;
  const double ratio = rootMeanSquareRadius(source, Eigen::Vector3f::Zero()) /
                       rootMeanSquareRadius(target, Eigen::Vector3f::Zero());
  CenterGrid on_source = centers, on_target = centers;
  on_target.reach *= std::max(1.0, ratio);
  on_source.reach *= std::max(1.0, 1.0 / ratio);
  // A part is smaller than the whole, its pre-shape too large: what is turned upon the
  // other cloud has to shrink, and one step more if the other is a part, too.
  const ScaleRange shrunk{scales.smallest, scales.clamp(scale_step)};
  const ScaleRange grown{scales.clamp(1.0 / scale_step), scales.largest};
  if (settings.mode == Mode::PARTIAL_PARTIAL)
    return {onTarget(shrunk, on_target, {both}), onSource(grown, on_source, {both})};
  return {onTarget(shrunk, on_target, {both, from_source}),
          onSource(grown, on_source, {both, from_target})};
}

} // namespace kss
} // namespace pcl
