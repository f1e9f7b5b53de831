/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/detail/points.h>

#include "geometry/nearest_points.h"

#include <memory>

namespace pcl {
namespace kss {

/** \brief A surface that is known by points on it. */
struct OrientedPoints {
  /** \brief The points, and what finds the nearest of them. */
  std::shared_ptr<const NearestPoints> points;
  /** \brief Unit normals, a column per point. */
  Points normals;
  /** \brief Whether their signs say which side is outside. */
  bool has_sides = false;
  /** \brief How far the points lie off their planes, standard deviation, in the unit of
   * the points; see noiseAbout(). */
  float noise = 0.0f;
};

} // namespace kss
} // namespace pcl
