/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/detail/points.h>

#include "geometry/neighbourhoods.h"

namespace pcl {
namespace kss {

/** \brief The planes that the points of a cloud and their neighbours lie about. */
struct TangentPlanes {
  /** \brief Unit normals, a column per point. */
  Points normals;
  /** \brief How far the points of a neighbourhood lie off its plane, root mean square:
   * noise, and what the surface bends. */
  Eigen::VectorXf thickness;
};

/** \brief Fit planes to neighbourhoods: the direction in which they spread least.
 * \param[in] points a cloud
 * \param[in] neighbourhoods of it
 * \param[in] threads 0: as many as there are cores
 */
TangentPlanes
tangentPlanes(const Points& points,
              const Neighbourhoods& neighbourhoods,
              unsigned int threads);

} // namespace kss
} // namespace pcl
