/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "io/geometry.h"

#include <pcl/registration/kss/detail/packed_tree.h>

#include <memory>
#include <vector>

namespace tool {

/** \brief Points that can be asked how far they are. */
class NearestPoints {
public:
  /** \param[in] points at least one, all finite */
  explicit NearestPoints(const Points& points);

  /** \brief How far the nearest of them is from a position. */
  double
  distanceFrom(const Eigen::Vector3d& position) const;

  /** \brief How far half of them are from the nearest other one at most. */
  double
  spacing() const
  {
    return spacing_;
  }

private:
  Eigen::Vector3d origin_;
  std::unique_ptr<const pcl::kss::PackedTree> tree_;
  double spacing_ = 0.0;
};

/** \brief How far the points of one cloud are from another one. */
struct Distances {
  /** \brief Of each point. */
  std::vector<double> all;
  double median, root_mean_square;
  /** \brief 95 % are not farther away. */
  double most;
  /** \brief How far the nearest points of the other cloud are from each other. */
  double spacing;
  /** \brief Where the scale of colours ends: what is farther away is far off. */
  double top;
};

/** \brief The distances of points from the nearest of others.
 * \param[in] points at least one, all finite
 */
Distances
distancesOf(const Points& points, const NearestPoints& others);

} // namespace tool
