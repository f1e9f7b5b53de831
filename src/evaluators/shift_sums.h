/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "evaluators/shift_lattice.h"

#include <memory>
#include <string>

namespace pcl {
namespace kss {

/** \brief Sums of truncated distances to one cloud at all centres of a grid at once. */
class ShiftSums {
public:
  /** \brief Points whose distances can be summed: the sums fit into sixteen bits. */
  static constexpr Eigen::Index most_points = 128;

  virtual ~ShiftSums() = default;

  /** \brief Set the cloud that distances are to, and the centres. */
  virtual void
  setField(const Points& cloud, const ShiftLattice& lattice) = 0;

  /** \brief The sums over the points, turned and scaled by each placement: the sums of
   * the rows of the lattice, placement by placement. A distance counts 255 at most.
   * \param[in] points at most \ref most_points
   * \param[in] placements ShiftLattice::toNodes of what turns and scales them
   */
  virtual std::vector<std::uint16_t>
  sums(const Points& points, const std::vector<Placement>& placements) = 0;
};

/** \brief Sums on the host.
 * \param[in] threads 0: as many as there are cores
 */
std::unique_ptr<ShiftSums>
makeHostShiftSums(unsigned int threads);

/** \brief Sums on an OpenCL device.
 * \param[in] device part of a name, or "auto": see Settings::device
 * \param[in] threads compute units to use of a CPU device; 0: all
 * \throws DeviceError where there is no such device or it does not work
 */
std::unique_ptr<ShiftSums>
makeOpenCLShiftSums(const std::string& device, unsigned int threads);

} // namespace kss
} // namespace pcl
