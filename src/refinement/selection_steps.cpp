/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "refinement/selection_steps.h"

#include "geometry/pose_metric.h"

#include <algorithm>
#include <cmath>

namespace pcl {
namespace kss {
namespace {

/** All poses. */
constexpr std::size_t all = -1;

/** What a few iterations from afar leave of the distance. */
constexpr double near = 0.12;

/** The scores of right poses lie within a factor of two; one that scores less than half
 * of the best is not worth more work. */
constexpr double hopeless = 0.5;

/** Points that tell the overlap of a pose on the way. */
constexpr Eigen::Index overlap_probes = 1000;

/** Where refinement with the simplified points ends: within their spacing, which is 2
 * over the root of their number on a sphere, with something to spare. */
double
nearest(Eigen::Index samples)
{
  return std::max(0.06, 1.5 * (2.0 / std::sqrt(samples)));
}

} // namespace

// So many poses, points and iterations that no step but the last costs more than the
// first, of up to 320 minima with few points: 130,000 to 250,000 correspondences.

std::vector<SelectionStep>
stepsFromAfar(const SelectionEffort& effort, Eigen::Index samples)
{
  const double nearer = effort.unit * nearest(samples), nearby = effort.unit * near;
  // two poses that end less than half a step of the rotations apart are one
  SelectionStep first{
      all, {64, 6, effort.reach, nearby, false}, PoseCost::DISTANCE, 64, 0.15};
  first.limit = effort.first_limit;
  SelectionStep second{
      effort.near, {200, 8, nearby, nearer, false}, PoseCost::DISTANCE, 200, 0.12};
  second.limit = effort.second_limit;
  return {first, second};
}

std::vector<SelectionStep>
stepsOnSurfaces(const SelectionEffort& effort,
                double spacing,
                Eigen::Index samples,
                bool is_noisy)
{
  // from what the steps from afar leave to the spacing, within which one surface covers
  // another
  const double wide = std::max(effort.unit * nearest(samples), 4.0 * spacing);
  const Eigen::Index probes = is_noisy ? most_probes : overlap_probes;
  const PoseCost cost = effort.is_dense ? PoseCost::SURFACES : PoseCost::OVERLAP;
  const std::size_t most =
      is_noisy ? std::max<std::size_t>(30, effort.on_surfaces) : effort.on_surfaces;
  const SelectionStep coarse{
      most, {400, 10, wide, 2.0 * spacing, is_noisy, true}, cost, probes, same_pose};
  SelectionStep fine{
      effort.last, {600, 40, wide, spacing, true, true}, cost, probes, same_pose};
  if (cost == PoseCost::OVERLAP)
    fine.hope = hopeless;
  // what averaging leaves has shallow minima beside the right one
  SelectionStep besides = fine;
  besides.most = 2;
  besides.hope.reset();
  besides.turned = true;
  // all that there is to decide by
  SelectionStep last = fine;
  last.effort = {most_probes, 12, 4.0 * spacing, spacing, true, true};
  last.on_clouds = true;
  if (is_noisy)
    return {coarse, fine, besides, last};
  return {coarse, fine, last};
}

} // namespace kss
} // namespace pcl
