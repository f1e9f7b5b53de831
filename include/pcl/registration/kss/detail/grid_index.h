/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <Eigen/Core>

#include <cstddef>

namespace pcl {
namespace kss {

/** \brief A coordinate as an index: the one place where floating point becomes an index
 * of a grid. Rounded down to a number from 0 to \a last, whatever it is, not a number
 * (0) included.
 */
template <typename Real>
int
toIndex(Real coordinate, int last)
{
  const Real inside = coordinate > Real(0) ? coordinate : Real(0);
  // a float can round the last index up
  return inside < static_cast<Real>(last) ? static_cast<int>(inside) : last;
}

/** \brief toIndex() along each axis.
 * \param[in] coordinates of a position
 * \param[in] last index along each axis
 */
template <typename Coordinates, typename Indices>
Eigen::Array3i
toIndices(const Coordinates& coordinates, const Indices& last)
{
  return {toIndex(coordinates[0], last[0]), toIndex(coordinates[1], last[1]),
          toIndex(coordinates[2], last[2])};
}

/** \brief How many cells a grid of a size has: more than an int can hold. */
template <typename Size>
std::size_t
numberOfCells(const Size& size)
{
  return static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]) *
         static_cast<std::size_t>(size[2]);
}

} // namespace kss
} // namespace pcl
