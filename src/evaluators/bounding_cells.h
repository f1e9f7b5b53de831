/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "evaluators/bounding_grid.h"

#include <vector>

namespace pcl {
namespace kss {

/** \brief A point of a cloud, and how much smaller the squared distance of the cloud
 * can be than that of the point, from anywhere in a cell: see
 * kernels/bounding_cells.cl. Lengths in cells.
 */
struct BoundingCell {
  Eigen::Vector3f point;
  float slack;
};

/** \brief The grid around a cloud that bounds its distances from anywhere. */
struct BoundingCells {
  BoundingGrid grid;
  std::vector<BoundingCell> cells; ///< x varies fastest
  std::vector<float> nodes;        ///< their squared distances, in cells
};

/** \brief Fill a grid.
 * \param[in] cloud at least one point
 * \param[in] grid around it
 * \param[in] threads 0: as many as there are cores
 */
BoundingCells
boundingCells(const Points& cloud, const BoundingGrid& grid, unsigned int threads);

} // namespace kss
} // namespace pcl
