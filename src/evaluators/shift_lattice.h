/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/detail/points.h>

#include "candidates/centers.h"
#include "geometry/placement.h"

#include <array>
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
           fold_ == other.fold_ && limit_ == other.limit_;
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

  /** \brief How many there are. */
  const Eigen::Array3i&
  inner() const
  {
    return inner_;
  }

  /** \brief Centres of a row, along z: their sums are a vector. Where few follow each
   * other along z, several of them along y are a row together.
   */
  static constexpr int lanes = 16;

  /** \brief How many rows are summed at once. */
  static constexpr int rows_at_once = 8;

  /** \brief The distances of all nodes to their nearest points, the limit as 255.
   * \param[in] cloud what the distances are to
   */
  std::vector<std::uint8_t>
  field(const Points& cloud) const;

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

  /** \brief Where nodes are stored: the sum of what each of their coordinates says. */
  const std::array<std::vector<std::uint32_t>, 3>&
  nodes() const
  {
    return nodes_;
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
  /** The cloud in the frame of the axes. */
  Points
  turned(const Points& cloud) const
  {
    return axes_.transpose() * cloud;
  }

  /** How many centres along y share a row where that saves rows. */
  static int
  foldFor(const Eigen::Array3i& counts);

  void
  placeNodes();

  Eigen::Matrix3f axes_;
  Eigen::Array3f lower_, step_;
  Eigen::Array3i every_, width_, inner_, all_, size_;
  /** How many centres along y share a row: beside each node lie those that are one, two
   * and so on centres farther along y, so that 16 bytes are few along z times some
   * along y. */
  int fold_ = 1;
  float limit_;
  std::array<std::vector<std::uint32_t>, 3> nodes_;
  std::vector<std::uint32_t> rows_, places_;
};

} // namespace kss
} // namespace pcl
