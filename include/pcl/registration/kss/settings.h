/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/export.h>

#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace pcl {
namespace kss {

/** \brief Which parts of the object the two clouds show. */
enum class Mode {
  AUTOMATIC,     ///< any of the others, found in one search; where the scale is unknown
                 ///< one cloud is expected to be nearly complete (default)
  GLOBAL_GLOBAL, ///< both clouds are complete: (e9) and (e10), centres coincide
  PARTIAL_GLOBAL,  ///< one cloud, either, is a part of the other: (e122) to (e13)
  PARTIAL_PARTIAL, ///< both are incomplete and share a part
  IN_SCENE ///< the smaller cloud is an object somewhere in the larger one, among other
           ///< things; at a known scale
};

/** \brief What the rotation of the result is about. */
enum class RotationAxis {
  ANY, ///< any axis (default)
  X,   ///< the x axis of both clouds: they are upright along it, or lie alike
  Y,   ///< the y axis of both clouds
  Z    ///< the z axis of both clouds: levelled scans
};

/** \brief How the simplification spreads its points over the cloud. */
enum class Density {
  UNIFORM, ///< by occupied area: uneven input density is evened out (default)
  PAPER    ///< by point count, (e5) of the paper: the input's density is kept
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
  EXACT     ///< the minima that all pairs of points give, by bounds from look-ups: from
            ///< all pairs only where bounds decide nothing
};

/** \brief Told how far a running registration has come.
 *
 * Called from the thread that called align(), with the name of the stage and the share
 * of it that is done, in [0, 1].
 */
using ProgressCallback = std::function<void(const std::string& stage, double done)>;

/** \brief Everything that KSSICP can be told beyond what it inherits.
 *
 * What each of them means, its unit and its bounds are written down once, in the table
 * of settings_table.h; docs/settings.md shows it.
 */
struct Settings {
  /** \brief See its row of the table. */
  /** \{ */
  Mode mode = Mode::AUTOMATIC;
  bool estimate_scale = true;
  double smallest_scale = 0.0;
  double largest_scale = std::numeric_limits<double>::infinity();
  RotationAxis rotation_axis = RotationAxis::ANY;

  bool clean = true;
  unsigned int sample_points = 2000;
  Density density = Density::UNIFORM;

  RotationSet rotation_set = RotationSet::EVEN;
  unsigned int even_rotations = 1728;
  double angle_step = 0.52359877559829887; // pi / 6
  CenterSet center_set = CenterSet::SPREAD;
  Energy energy = Energy::TRUNCATED_MEAN;
  Search search = Search::SCREENED;
  unsigned int search_points = 96;
  unsigned int local_minimum_kernel = 3;
  double additional_process_threshold = 0.0;

  unsigned int icp_points = 10000;
  double minimum_confidence = 0.5;
  double time_limit = 0.0;
  std::string device = "auto";
  unsigned int threads = 0;
  /** \} */
  /** Called as the work proceeds; may be empty. */
  ProgressCallback progress;
};

/** \brief The settings of the paper: Hausdorff distances of all pairs of points, the
 * Euler grid, its centres, voxel quotas by count, clouds as they are.
 *
 * The mode becomes GLOBAL_GLOBAL where it was AUTOMATIC: the paper leaves the choice to
 * the user. Scale estimation, confidence, time limit, device, threads and progress
 * stay.
 */
PCL_KSS_ICP_EXPORT Settings
paperSettings(Settings settings);

/** \brief Whether two settings ask Alignment for the same work; what comes after it,
 * and who is told of its progress, aside. */
PCL_KSS_ICP_EXPORT bool
sameWork(const Settings& a, const Settings& b);

/** \brief The search that runs: SCREENED is for TRUNCATED_MEAN and SPREAD centres, and
 * otherwise becomes EXACT. */
PCL_KSS_ICP_EXPORT Search
searchOf(const Settings& settings);

/** \brief Settings that are all within their bounds. */
struct CheckedSettings {
  Settings settings; ///< those asked for, as far as they are within bounds
  /** \brief A sentence on each value that was asked for and is out of bounds. */
  std::vector<std::string> refusals;
};

/** \brief Take settings over, one by one; the bounds of the scale as a pair.
 * \param[in] asked
 * \param[in] before what stays where the value asked for is out of bounds
 */
PCL_KSS_ICP_EXPORT CheckedSettings
checked(const Settings& asked, const Settings& before);

} // namespace kss
} // namespace pcl
