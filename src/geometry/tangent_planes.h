/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/detail/points.h>

#include "geometry/neighbourhoods.h"

namespace pcl {
namespace kss {

/** \brief Cosine of the angle between normals that agree, where surfaces are smooth. */
constexpr float agreeing = 0.8f;

/** \brief The planes that the surface of a cloud has at its points, and how far they
 * can be trusted. */
struct TangentPlanes {
  /** \brief Unit normals, a column per point. */
  Points normals;
  /** \brief Whether their signs say which side is outside. */
  bool has_sides = false;
  /** \brief How far a point's neighbours lie off its plane, by noise or because the
   * surface bends: as a standard deviation, in the unit of the points. */
  Eigen::VectorXf deviations;
  /** \brief The cosine between a point's normal and those of its nearest neighbours,
   * signs aside: edges, and what is thin for the spacing of its points, have low ones.
   */
  Eigen::VectorXf agreements;
  /** \brief The noise of the cloud: the median of the deviations. */
  float noise = 0.0f;
};

/** \brief The normals of planes through the points of a cloud and their neighbours: the
 * directions in which these spread least.
 * \param[in] points a cloud
 * \param[in] neighbourhoods of it
 * \param[in] threads 0: as many as there are cores
 * \return unit normals of either sign, a column per point
 */
Points
normalsOf(const Points& points,
          const Neighbourhoods& neighbourhoods,
          unsigned int threads);

/** \brief Measure how far planes can be trusted.
 *
 * A deviation is told by the nearer ones of a dozen neighbours, so that the other skin
 * of a thin wall does not pass for noise.
 * \param[in] points at least one
 * \param[in] neighbourhoods of them
 * \param[in] threads 0: as many as there are cores
 * \param[in,out] planes whose normals are known
 */
void
measureTrust(const Points& points,
             const Neighbourhoods& neighbourhoods,
             unsigned int threads,
             TangentPlanes& planes);

} // namespace kss
} // namespace pcl
