/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/detail/points.h>

#include "candidates/energy.h"
#include "geometry/placement.h"

#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace pcl {
namespace kss {

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

/** \brief All pairs of points on the host: the reference.
 * \param[in] threads 0: as many as there are cores
 */
std::unique_ptr<DistanceEvaluator>
makeHostPairDistances(unsigned int threads);

/** \brief All pairs of points on an OpenCL device.
 * \param[in] device part of a name, or "auto": see Settings::device
 * \param[in] threads compute units to use of a CPU device; 0: all
 * \throws DeviceError where there is no such device or it does not work
 */
std::unique_ptr<DistanceEvaluator>
makeOpenCLPairDistances(const std::string& device, unsigned int threads);

/** \brief Look-ups in distance fields on the host.
 *
 * A distance is that of the centre of the field's cell that a point falls into, within
 * the field, whose margin is twice as wide as the limit. It is too short by half a
 * diagonal of a cell at most. It is seldom too long by more, since few cells miss their
 * nearest point by much (see DistanceField); for sure it is no longer than sqrt(3)
 * times the true one and 2.3 diagonals.
 * \param[in] threads 0: as many as there are cores
 * \param[in] probes points of each cloud, the first ones, whose distances are looked up
 */
std::unique_ptr<DistanceEvaluator>
makeHostLookUps(unsigned int threads, unsigned int probes);

/** \brief Look-ups in distance fields on an OpenCL device: as on the host.
 * \param[in] device part of a name, or "auto": see Settings::device
 * \param[in] threads compute units to use of a CPU device; 0: all
 * \param[in] probes points of each cloud, the first ones, whose distances are looked up
 * \throws DeviceError where there is no such device or it does not work
 */
std::unique_ptr<DistanceEvaluator>
makeOpenCLLookUps(const std::string& device,
                          unsigned int threads,
                          unsigned int probes);

} // namespace kss
} // namespace pcl
