/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <functional>
#include <string>

namespace pcl {
namespace kss {

/** \brief How the simplification spreads its points over the cloud. */
enum class Density {
  UNIFORM, ///< by occupied area: uneven input density is evened out (default)
  PAPER    ///< by point count, (e5) of the paper: the input's density is kept
};

/** \brief The candidate rotations {O}. */
enum class RotationSet {
  EULER, ///< (e10): all triples of multiples of the angle step about x, y and z
         ///< (default)
  EVEN ///< a super-Fibonacci spiral: any number of rotations, evenly spread over SO(3)
};

/** \brief Told how far a running registration has come.
 *
 * Called from the thread that called align(), with the name of the stage and the share
 * of it that is done, in [0, 1].
 */
using ProgressCallback = std::function<void(const std::string& stage, double done)>;

/** \brief Everything the initial alignment can be told; the defaults are the paper's
 * unless a comment says otherwise.
 */
struct Settings {
  /** Points k of a simplified cloud. */
  unsigned int sample_points = 2000;
  /** How the k points are spread. The paper's is Density::PAPER. */
  Density density = Density::UNIFORM;
  /** Which rotations are tried. */
  RotationSet rotation_set = RotationSet::EULER;
  /** Step theta of the Euler grid, in radians. */
  double angle_step = 0.52359877559829887; // pi / 6
  /** Number of rotations of the even set. */
  unsigned int even_rotations = 1728;
  /** Edge of the kernel in which a local minimum is the smallest, in steps; odd. */
  unsigned int local_minimum_kernel = 5;
  /** Energy above which further local minima are refined, Q_the of (e12), as a fraction
   * of the cloud's root mean square radius. */
  double additional_process_threshold = 0.001;
  /** Whether the relative scale is unknown and estimated. */
  bool estimate_scale = true;
  /** "auto": the first OpenCL device, GPUs first, else the host; "host": no OpenCL;
   * anything else: the OpenCL device whose name contains it. */
  std::string device = "auto";
  /** Threads, on the host and on an OpenCL CPU device; 0: as many as there are cores.
   */
  unsigned int threads = 0;
  /** Called as the work proceeds; may be empty. */
  ProgressCallback progress;
};

} // namespace kss
} // namespace pcl
