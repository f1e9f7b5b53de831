/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "geometry/nearest_points.h"
#include "geometry/tangent_planes.h"

#include <memory>

namespace pcl {
namespace kss {

/** \brief A surface that is known by points on it. */
struct OrientedPoints {
  /** \brief The points, and what finds the nearest of them. */
  std::shared_ptr<const NearestPoints> points;
  /** \brief Its planes at these points. */
  TangentPlanes planes;
};

} // namespace kss
} // namespace pcl
