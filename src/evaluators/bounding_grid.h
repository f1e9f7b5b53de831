/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/detail/grid_index.h>
#include <pcl/registration/kss/detail/points.h>

#include "geometry/clouds.h"
#include "support/rounded_up.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl {
namespace kss {

/** \brief Where the nodes of a grid around a cloud lie. */
struct BoundingGrid {
  /** \brief The first node. */
  Eigen::Vector3f lower;
  /** \brief The edge of a cell. */
  float edge;
  /** \brief Nodes along x, y and z; along x a multiple of eight. */
  Eigen::Vector3i size;
  /** \brief How far rounding can move a position, in cells. */
  float rounding;
  /** \brief The slack of the cells at the border, which stand for all positions beyond:
   * -1e30 where the largest known distance is reached there, 1e30 where nothing is
   * known. */
  float border;
  /** \brief No distance is known to be larger, in cells. */
  float largest_known;
};

/** \brief How far rounding can move a point, for its largest coordinate: a placed one
 * is a sum of four products, and its inverse of a few more. */
inline float
roundingOf(float coordinate)
{
  return 16.0f * Eigen::NumTraits<float>::epsilon() * coordinate;
}

/** \brief A grid of so many nodes over a box. Its outermost cells lie beyond the box.
 * \param[in] lower corner of the box
 * \param[in] upper corner of the box
 * \param[in] nodes how many there may be
 * \param[in] largest coordinate that occurs
 */
inline BoundingGrid
gridOver(const Eigen::Array3f& lower,
         const Eigen::Array3f& upper,
         std::size_t nodes,
         float largest)
{
  const Eigen::Array3f extent = (upper - lower).max(0.0f);
  BoundingGrid grid;
  grid.edge = extent.maxCoeff() > 0.0f ? extent.maxCoeff() / 256.0f : 1.0f;
  for (;; grid.edge *= 1.04f) {
    // a little more, for rounding
    grid.size = toIndices(Eigen::Array3f((extent / grid.edge + 0.02f).ceil()),
                          Eigen::Array3i::Constant(1 << 20)) +
                3;
    grid.size.x() = roundedUp(grid.size.x(), 8);
    if (numberOfCells(grid.size) <= std::max<std::size_t>(nodes, 8 * 4 * 4))
      break;
  }
  grid.lower = lower - 1.01f * grid.edge;
  grid.rounding = roundingOf(2.0f * largest) / grid.edge;
  grid.border = 1e30f;
  grid.largest_known = std::numeric_limits<float>::max();
  return grid;
}

/** \brief A grid for distances up to a margin around a cloud. */
inline BoundingGrid
gridAround(const Points& cloud, float margin, std::size_t nodes, float largest)
{
  const Eigen::AlignedBox3f box = boxOf(cloud);
  BoundingGrid grid =
      gridOver(box.min().array() - margin, box.max().array() + margin, nodes, largest);
  grid.border = -1e30f;
  grid.largest_known = margin / grid.edge;
  return grid;
}

/** \brief A grid for any distance, from positions within reach of the origin. */
inline BoundingGrid
gridWithin(float reach, std::size_t nodes, float largest)
{
  return gridOver(Eigen::Array3f::Constant(-reach), Eigen::Array3f::Constant(reach),
                  nodes, largest);
}

} // namespace kss
} // namespace pcl
