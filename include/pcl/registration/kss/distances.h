/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/points.h>
#include <pcl/registration/kss/settings.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace pcl {
namespace kss {

/** \brief Places the source: the upper three rows of a similarity. */
using Placement = Eigen::Matrix<float, 3, 4, Eigen::RowMajor>;

/** \brief How far a placed source and the target lie apart. */
struct DirectedDistances {
  /** \brief The directed Hausdorff distance from the source: the largest distance of a
   * source point to its nearest target point. */
  float source_to_target;
  /** \brief The mean of those distances, none counted beyond the limit. */
  float mean_source_to_target;
  /** \brief The directed Hausdorff distance from the target. */
  float target_to_source;
  /** \brief The mean distance of the target points to their nearest source points, none
   * counted beyond the limit. */
  float mean_target_to_source;

  /** \brief The Hausdorff distance H of (e9): the larger of the directed ones. */
  float
  hausdorff() const
  {
    return std::max(source_to_target, target_to_source);
  }
};

/** \brief Computes the distances of many placements of one source on one target. */
class DistanceEvaluator {
public:
  virtual ~DistanceEvaluator() = default;

  /** \brief Set the two clouds.
   * \param[in] source at least one point
   * \param[in] target at least one point
   * \param[in] limit what a distance counts in the means at most
   */
  virtual void
  setClouds(const Points& source,
            const Points& target,
            float limit = std::numeric_limits<float>::max()) = 0;

  /** \brief The distances of all placements, in their order. */
  virtual std::vector<DirectedDistances>
  evaluate(const std::vector<Placement>& placements) = 0;

  /** \brief The name of the device that does the work. */
  virtual std::string
  deviceName() const = 0;
};

/** \brief All pairs of points, where the settings say: with the device "auto" the host
 * takes over, with one warning, where no OpenCL device can be had, and when it fails.
 * \throws DeviceError where a device asked for by name cannot be had; so do its calls
 *   where it fails
 */
std::unique_ptr<DistanceEvaluator>
makeEvaluator(const Settings& settings);

/** \brief Look-ups of the first Settings::search_points of each cloud, where the
 * settings say; as makeEvaluator().
 */
std::unique_ptr<DistanceEvaluator>
makeLookUpEvaluator(const Settings& settings);

/** \brief All pairs of points on the host: the reference.
 * \param[in] threads 0: as many as there are cores
 */
std::unique_ptr<DistanceEvaluator>
makeHostEvaluator(unsigned int threads);

/** \brief All pairs of points on an OpenCL device.
 * \param[in] device part of a name, or "auto": see Settings::device
 * \param[in] threads compute units to use of a CPU device; 0: all
 * \throws DeviceError where there is no such device or it does not work
 */
std::unique_ptr<DistanceEvaluator>
makeOpenCLEvaluator(const std::string& device, unsigned int threads);

/** \brief Look-ups in distance fields on the host.
 *
 * A distance is that of the centre of the field's cell that a point falls into, within
 * the field, whose margin is twice as wide as the limit. It is too short by half a
 * diagonal of a cell at most. It is seldom too long by more, since few cells miss their
 * nearest point by much (see DistanceField); for sure it is no longer than sqrt(3) times
 * the true one and 2.3 diagonals.
 * \param[in] threads 0: as many as there are cores
 * \param[in] probes points of each cloud, the first ones, whose distances are looked up
 */
std::unique_ptr<DistanceEvaluator>
makeHostLookUpEvaluator(unsigned int threads, unsigned int probes);

/** \brief Look-ups in distance fields on an OpenCL device: as on the host.
 * \param[in] device part of a name, or "auto": see Settings::device
 * \param[in] threads compute units to use of a CPU device; 0: all
 * \param[in] probes points of each cloud, the first ones, whose distances are looked up
 * \throws DeviceError where there is no such device or it does not work
 */
std::unique_ptr<DistanceEvaluator>
makeOpenCLLookUpEvaluator(const std::string& device,
                          unsigned int threads,
                          unsigned int probes);

} // namespace kss
} // namespace pcl
