/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/export.h>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>

namespace pcl {
namespace kss {

/** \brief The points that are nearest to a position. */
struct NearestTwo {
  std::int32_t nearest = -1; ///< index; -1: none within the limit
  std::int32_t second = -1;  ///< index of the second nearest; -1: none within the limit
  float squared = std::numeric_limits<float>::infinity();        ///< distance
  float second_squared = std::numeric_limits<float>::infinity(); ///< distance
};

/** \brief Finds nearest points, exactly.
 *
 * Points are sorted along a space-filling curve and packed, so many to a leaf and so
 * many leaves to a node, each of which knows the box around what it holds (I. Kamel, C.
 * Faloutsos, "On packing R-trees", 1993). That takes a fraction of the time in which a
 * k-d tree is built, adapts to any density, and asks several boxes, or points, at once.
 * Searches may run at the same time.
 */
class PCL_KSS_ICP_EXPORT PackedTree {
public:
  /** \param[in] first the coordinates of the first point of a cloud
   * \param[in] stride from one point to the next, in floats
   * \param[in] size number of points; those that are not finite are left out, and at
   * least one is finite
   */
  PackedTree(const float* first, std::size_t stride, std::size_t size);

  ~PackedTree();

  /** \brief The two points nearest to a position.
   * \param[in] position three coordinates
   * \param[in] squared_limit points farther away are not looked for
   */
  NearestTwo
  nearest(const float* position,
          float squared_limit = std::numeric_limits<float>::infinity()) const;

private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

} // namespace kss
} // namespace pcl
