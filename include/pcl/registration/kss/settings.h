/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <functional>
#include <limits>
#include <string>
#include <tuple>

namespace pcl {
namespace kss {

/** \brief Which parts of the object the two clouds show. */
enum class Mode {
  AUTOMATIC,      ///< all of the others are tried, and the best pose wins (default)
  GLOBAL_GLOBAL,  ///< both clouds are complete: (e9) and (e10), centres coincide
  PARTIAL_GLOBAL, ///< one cloud, either, is a part of the other: (e122) to (e13)
  PARTIAL_PARTIAL ///< both are incomplete and share a part
};

/** \brief How the simplification spreads its points over the cloud. */
enum class Density {
  UNIFORM, ///< by occupied area: uneven input density is evened out (default)
  PAPER,   ///< by point count, (e5) of the paper: the input's density is kept
  RANDOM   ///< not at all, any point may come: what the others are measured against
};

/** \brief The candidate rotations {O}. */
enum class RotationSet {
  EULER, ///< (e10): all triples of multiples of the angle step about x, y and z
  EVEN ///< a super-Fibonacci spiral: any number of rotations, evenly spread over SO(3)
       ///< (default)
};

/** \brief The candidate centres {C}. */
enum class CenterSet {
  PAPER, ///< (e123): a cube of 5 x 5 x 5 in the local frame of the incomplete cloud
  SPREAD ///< a box along the principal axes, as far as the object reaches (default)
};

/** \brief What makes a candidate good. */
enum class Energy {
  HAUSDORFF, ///< (e9) and (e122): the largest distance of a point to the other cloud
  TRUNCATED_MEAN ///< the mean of those distances, none counted beyond a limit: forgives
                 ///< points without a counterpart (default)
};

/** \brief How the candidates' distances are computed. */
enum class Search {
  SCREENED, ///< few points tell which candidates deserve a closer look, by look-ups in
            ///< distance fields: for TRUNCATED_MEAN and SPREAD centres, else as EXACT
            ///< (default)
  EXACT,    ///< the same answer as brute force, by bounds from look-ups: from all
            ///< pairs of points only where bounds decide nothing
  BRUTE_FORCE ///< from all pairs of points: the reference
};

/** \brief Told how far a running registration has come.
 *
 * Called from the thread that called align(), with the name of the stage and the share
 * of it that is done, in [0, 1].
 */
using ProgressCallback = std::function<void(const std::string& stage, double done)>;

/** \brief Everything the initial alignment can be told. */
struct Settings {
  /** What the clouds show. */
  Mode mode = Mode::AUTOMATIC;
  /** Points k of a simplified cloud. */
  unsigned int sample_points = 2000;
  /** How the k points are spread. */
  Density density = Density::UNIFORM;
  /** Whether stray points are dropped and heavy noise is averaged before. */
  bool clean = true;
  /** Which rotations are tried. */
  RotationSet rotation_set = RotationSet::EVEN;
  /** Step theta of the Euler grid, in radians. */
  double angle_step = 0.52359877559829887; // pi / 6
  /** Number of rotations of the even set. */
  unsigned int even_rotations = 1728;
  /** Which centres are tried where a cloud may be incomplete. */
  CenterSet center_set = CenterSet::SPREAD;
  /** What is minimal at the right candidate. */
  Energy energy = Energy::TRUNCATED_MEAN;
  /** How the energy is computed. */
  Search search = Search::SCREENED;
  /** Points of each simplified cloud that take part in a screened search; 128 at most.
   */
  unsigned int search_points = 96;
  /** Edge of the kernel of rotations in which a local minimum is the smallest, in
   * steps. */
  unsigned int local_minimum_kernel = 3;
  /** Energy above which further local minima are refined, Q_the of (e12), as a fraction
   * of the target's root mean square radius; 0: always. */
  double additional_process_threshold = 0.0;
  /** Whether the relative scale is unknown and estimated. */
  bool estimate_scale = true;
  /** Smallest scale of the transformation where it is estimated. */
  double smallest_scale = 0.0;
  /** Largest scale of the transformation where it is estimated. */
  double largest_scale = std::numeric_limits<double>::infinity();
  /** Points of the source that take part in the final ICP on the target as it is; 0:
   * all. */
  unsigned int icp_points = 10000;
  /** "auto": the first OpenCL device, GPUs first, else the host; "host": no OpenCL;
   * anything else: all OpenCL devices of the platform whose name contains it, else
   * the device whose name does. */
  std::string device = "auto";
  /** Threads, on the host and on an OpenCL CPU device; 0: as many as there are cores.
   */
  unsigned int threads = 0;
  /** Called as the work proceeds; may be empty. */
  ProgressCallback progress;
};

/** \brief Whether two settings ask for the same work; who is told of its progress, and
 * the ICP after it, aside. */
inline bool
sameWork(const Settings& a, const Settings& b)
{
  const auto work = [](const Settings& s) {
    return std::tie(s.mode, s.sample_points, s.density, s.clean, s.rotation_set,
                    s.angle_step, s.even_rotations, s.center_set, s.energy, s.search,
                    s.search_points, s.local_minimum_kernel,
                    s.additional_process_threshold, s.estimate_scale, s.smallest_scale,
                    s.largest_scale, s.device, s.threads);
  };
  return work(a) == work(b);
}

/** \brief The settings of the paper: Hausdorff distances of all pairs of points, the
 * Euler grid, its centres, voxel quotas by count, clouds as they are.
 *
 * The mode becomes GLOBAL_GLOBAL where it was AUTOMATIC: the paper leaves the choice to
 * the user. Scale estimation, device, threads and progress stay.
 */
inline Settings
paperSettings(Settings settings)
{
  if (settings.mode == Mode::AUTOMATIC)
    settings.mode = Mode::GLOBAL_GLOBAL;
  settings.sample_points = 2000;
  settings.density = Density::PAPER;
  settings.clean = false;
  settings.rotation_set = RotationSet::EULER;
  settings.angle_step = Settings().angle_step;
  settings.center_set = CenterSet::PAPER;
  settings.icp_points = 0;
  settings.energy = Energy::HAUSDORFF;
  settings.search = Search::EXACT;
  settings.local_minimum_kernel = 5;
  settings.additional_process_threshold = 0.001;
  return settings;
}

} // namespace kss
} // namespace pcl
