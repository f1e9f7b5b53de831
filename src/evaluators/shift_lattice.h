/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/detail/points.h>

#include "candidates/centers.h"
#include "geometry/placement.h"

#include <cstdint>
#include <vector>

namespace pcl {
namespace kss {

/** \brief The nodes of a distance field that candidate centres fall on, in the order
 * that shift_sums.cl asks for.
 *
 * They are \ref most_nodes at most, a byte each: where one cloud is so much larger than
 * the other that its centres reach far beyond the other, they lie farther apart.
 */
class ShiftLattice {
public:
  /** \brief Enough for the widest lattice that nodes as close as the limit asks for can
   * be worth. */
  static constexpr int most_nodes = 1 << 26;

  /** \param[in] cloud what the distances are to
   * \param[in] centers a grid around the origin
   * \param[in] limit what a distance counts at most
   * \throws std::invalid_argument where centres alone are more than the nodes
   */
  ShiftLattice(const Points& cloud, const CandidateCenters& centers, float limit);

  bool
  operator==(const ShiftLattice& other) const
  {
    return axes_ == other.axes_ && (lower_ == other.lower_).all() &&
           (step_ == other.step_).all() && (every_ == other.every_).all() &&
           (width_ == other.width_).all() && (inner_ == other.inner_).all() &&
           limit_ == other.limit_;
  }

  /** \brief The nodes beyond which no distance is below the limit, a regular grid: the
   * first one, in the frame of the axes of the centres. */
  const Eigen::Array3f&
  lower() const
  {
    return lower_;
  }

  /** \brief From node to node. */
  const Eigen::Array3f&
  step() const
  {
    return step_;
  }

  /** \brief How many there are, along z a multiple of \ref vector. */
  const Eigen::Array3i&
  inner() const
  {
    return inner_;
  }

  static constexpr int vector = 32;

  /** \brief Centres of a row, along z: their sums are a vector. */
  static constexpr int lanes = 16;

  /** \brief How many rows are summed at once. */
  static constexpr int rows_at_once = 8;

  /** \brief The cloud in the frame of the axes. */
  Points
  turned(const Points& cloud) const
  {
    return axes_.transpose() * cloud;
  }

  /** \brief The whole field in bytes, the limit as 255.
   * \param[in] distances of the inner nodes, z varies fastest
   */
  std::vector<std::uint8_t>
  bytes(const std::vector<float>& distances) const;

  /** \brief From a matrix that turns and scales points to the one that takes them to
   * nodes under the first centre. */
  Placement
  toNodes(const Eigen::Matrix3f& linear) const;

  /** \brief The last node that the first centre may fall on. */
  Eigen::Array3i
  last() const
  {
    return all_ - 1 - width_;
  }

  /** \brief Nodes from centre to centre. */
  const Eigen::Array3i&
  every() const
  {
    return every_;
  }

  /** \brief Nodes of an array along each axis. */
  const Eigen::Array3i&
  size() const
  {
    return size_;
  }

  /** \brief Where the rows of \ref lanes centres begin, filled up to as many as are
   * summed at once. */
  const std::vector<std::uint32_t>&
  rows() const
  {
    return rows_;
  }

  /** \brief For each centre, where its sum is among those of all rows. */
  const std::vector<std::uint32_t>&
  places() const
  {
    return places_;
  }

private:
  Eigen::Matrix3f axes_;
  Eigen::Array3f lower_, step_;
  Eigen::Array3i every_, width_, inner_, all_, size_;
  float limit_;
  std::vector<std::uint32_t> rows_, places_;
};

} // namespace kss
} // namespace pcl
