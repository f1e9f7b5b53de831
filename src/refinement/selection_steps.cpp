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

std::vector<SelectionStep>
stepsFromAfar(double reach, Eigen::Index samples)
{
  const double nearer = nearest(samples);
  return {// few points for all minima; what moves less than a rotation's step is one
          {all,
           0.0,
           false,
           false,
           {64, 6, reach, near, false},
           PoseCost::DISTANCE,
           0.15,
           64,
           0.15},
          {60,
           0.0,
           false,
           false,
           {200, 8, near, nearer, false},
           PoseCost::DISTANCE,
           std::max(0.1, nearer),
           200,
           0.12}};
}

std::vector<SelectionStep>
stepsOnSurfaces(double spacing, Eigen::Index samples, bool is_noisy)
{
  const double wide = std::max(nearest(samples), 4.0 * spacing);
  const Refinement::Effort fine{600, 40, wide, spacing, true};
  const Eigen::Index overlap = is_noisy ? most_probes : overlap_probes;
  // the reach falls from a few spacings to one, within which a surface covers another
  std::vector<SelectionStep> steps{{is_noisy ? 30u : 16u,
                                    0.0,
                                    false,
                                    false,
                                    {400, 10, wide, 2.0 * spacing, is_noisy},
                                    PoseCost::OVERLAP,
                                    0.0,
                                    overlap,
                                    same_pose},
                                   {most_alternatives, hopeless, false, false, fine,
                                    PoseCost::OVERLAP, 0.0, overlap, same_pose}};
  // what averaging leaves has shallow minima beside the right one
  if (is_noisy)
    steps.push_back(
        {2, 0.0, true, false, fine, PoseCost::OVERLAP, 0.0, overlap, same_pose});
  steps.push_back({most_alternatives,
                   hopeless,
                   false,
                   true,
                   {most_probes, 100, 4.0 * spacing, spacing, true},
                   PoseCost::OVERLAP,
                   0.0,
                   overlap,
                   same_pose});
  return steps;
}

} // namespace kss
} // namespace pcl
