/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "evaluators/distance_evaluator.h"

#include <limits>
#include <memory>
#include <vector>

namespace pcl {
namespace kss {

/** \brief Distances between which those of a placement lie. */
struct DistanceBounds {
  DirectedDistances lower, upper;
};

/** \brief What bounds will be asked for. Beyond it they are not close. */
struct BoundsScope {
  /** \brief The scales of all placements lie in this range. */
  double smallest_scale = 1.0, largest_scale = 1.0;
  /** \brief The translation of no placement is longer. */
  double largest_shift = 0.0;
  /** \brief What a distance counts in the means at most. */
  float limit = std::numeric_limits<float>::max();
  /** \brief Whether distances beyond the limit matter: those of the largest distances
   * do. */
  bool beyond_limit = true;
  /** \brief The directions that matter; the bounds of another are 0. */
  bool source_to_target = true, target_to_source = true;
  /** \brief How many nodes a grid may have: the more, the closer the bounds. */
  std::size_t nodes = 1 << 17;
};

/** \brief Bounds of the distances of many placements of one source on one target, by a
 * look-up per point.
 *
 * They hold for what a DistanceEvaluator finds, its rounding errors included.
 */
class BoundsEvaluator {
public:
  virtual ~BoundsEvaluator() = default;

  /** \brief Set the two clouds.
   * \param[in] source at least one point
   * \param[in] target at least one point
   * \param[in] scope what will be asked for
   */
  virtual void
  setClouds(const Points& source, const Points& target, const BoundsScope& scope) = 0;

  /** \brief The bounds of all placements, in their order.
   * \param[in] placements within the scope
   * \param[in] probes points of each cloud, the first ones, that are looked up; each
   * stands for the points that it is the nearest to, so that the bounds are the closer
   * the more evenly the probes cover the cloud
   */
  virtual std::vector<DistanceBounds>
  evaluate(const std::vector<Placement>& placements, Eigen::Index probes) = 0;
};

/** \brief Bounds on the host.
 * \param[in] threads 0: as many as there are cores
 */
std::unique_ptr<BoundsEvaluator>
makeHostBounds(unsigned int threads);

/** \brief Bounds on an OpenCL device.
 * \param[in] device part of a name, or "auto": see Settings::device
 * \param[in] threads compute units to use of a CPU device; 0: all
 * \throws DeviceError where there is no such device or it does not work
 */
std::unique_ptr<BoundsEvaluator>
makeOpenCLBounds(const std::string& device, unsigned int threads);

} // namespace kss
} // namespace pcl
