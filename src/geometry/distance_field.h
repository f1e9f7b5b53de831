/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/detail/grid_index.h>
#include <pcl/registration/kss/detail/points.h>

#include <array>
#include <vector>

namespace pcl {
namespace kss {

/** \brief A grid around a cloud, each cell of which knows a point near to its centre.
 *
 * Hardly ever is another point nearer by as much as an edge of a cell, though where a
 * cell holds several points, its neighbours learn of one of them alone. For sure, with
 * h half a diagonal of a cell: the point is no farther from the centre than sqrt(3)
 * times the distance of the nearest one and (1 + sqrt(3)) h.
 */
class DistanceField {
public:
  /** \param[in] points at least one
   * \param[in] cell the edge of a cell; it grows where more than four million cells
   * would be needed
   * \param[in] margin how far the grid reaches beyond the points, on all sides
   */
  DistanceField(const Points& points, float cell, float margin);

  /** \brief The cell of a position; beyond the grid, the nearest cell of its border. */
  std::size_t
  cellOf(const Eigen::Vector3f& position) const
  {
    return cellAt(coordinatesOf(position));
  }

  /** \brief The point near to the centre of a cell. */
  int
  nearest(std::size_t cell) const
  {
    return nearest_[cell];
  }

  /** \brief Its distance from the centre of the cell, for all cells: x varies fastest.
   */
  const std::vector<float>&
  distances() const
  {
    return distances_;
  }

  /** \brief The lower corner of the grid. */
  const Eigen::Vector3f&
  lower() const
  {
    return lower_;
  }

  /** \brief One over the edge of a cell. */
  float
  inverseEdge() const
  {
    return inverse_edge_;
  }

  /** \brief Cells along x, y and z. */
  const Eigen::Vector3i&
  size() const
  {
    return size_;
  }

private:
  /** \brief Of the cell of a position. */
  Eigen::Array3i
  coordinatesOf(const Eigen::Vector3f& position) const
  {
    return toIndices(Eigen::Vector3f((position - lower_) * inverse_edge_),
                     size_.array() - 1);
  }

  std::size_t
  cellAt(const Eigen::Array3i& at) const
  {
    return (static_cast<std::size_t>(at.z()) * size_.y() + at.y()) * size_.x() + at.x();
  }

  /** \brief Have every cell learn of its neighbours' points.
   * \param[in,out] places of the points, coordinates apart; beyond all where a cell
   * knows none
   */
  void
  spread(std::array<std::vector<float>, 3>& places);

  Eigen::Vector3f lower_;
  float inverse_edge_;
  Eigen::Vector3i size_;
  std::array<std::vector<float>, 3> centers_; ///< of cells, along each axis
  std::vector<int> nearest_;
  std::vector<float> distances_;
};

} // namespace kss
} // namespace pcl
