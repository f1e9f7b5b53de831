/*
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * The numbers of the search, each beside its reason. Lengths are in root mean square
 * radii of the target, angles in radians.
 */

#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace pcl {
namespace kss {
namespace search_numbers {

// What is tried.

/** Adjacent scales: ICP on many starts closes half such a gap easily. */
constexpr double scale_step = 1.25;

/** How far scales are tried, in steps either way: to about half and twice the size. */
constexpr int scale_steps = 3;

/** How far centres are looked for, in standard deviations of the cloud along an axis,
 * and how far apart. */
struct CenterGrid {
  double reach, step;
};

/** Of a part and the whole: if a body of even cross-section lacks half of itself, the
 * centre of the rest lies 0.87 standard deviations off; a little more than that. */
constexpr CenterGrid of_a_part{1.1, 0.36};

/** Of two parts: the centres lie up to twice as far apart, which few do. */
constexpr CenterGrid of_two_parts{1.6, 0.3};

/** Centres of a cloud that is much larger than the other at most. */
constexpr double most_centers = 10000.0;

/** What the second direction counts where one cloud is a part of the other: enough for
 * the energy not to fall when the part shrinks. */
constexpr float weight_of_other_direction = 0.25f;

// What counts as near.

/** About as far as a candidate next to the right pose leaves points off: beyond it a
 * distance does not count in the energy, and from it refinement starts.
 *
 * So many rotations that are spread evenly over SO(3), whose volume is 8 pi^2, lie a
 * step of (8 pi^2 / rotations)^(1/3) apart: 0.357 for 1728 of them. Half a step of the
 * rotations, of the centres and of the scales leave points off by 0.15, 0.18 and 0.12,
 * which come to between 0.26 (all independent) and 0.45 (all in line). With fewer
 * rotations it grows as their step does; with more it stays, since centres and scales
 * lie as far apart as before.
 */
inline double
reachOf(std::size_t rotations)
{
  constexpr double usual_rotations = 1728.0, usual_reach = 0.35;
  const double steps = std::cbrt(
      usual_rotations / static_cast<double>(std::max<std::size_t>(1, rotations)));
  return usual_reach * std::max(1.0, steps);
}

// How much is done.

/** Candidates that are evaluated at once: more would take memory for nothing. */
constexpr std::size_t at_once = 1 << 16;

/** Gigabytes that the candidates of a sweep may take. */
constexpr double most_memory = 4.0;

/** Minima closer than this are one that several energies share. */
constexpr double same_minimum = 1e-3;

} // namespace search_numbers
} // namespace kss
} // namespace pcl
