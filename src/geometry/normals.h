/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/detail/points.h>

#include "geometry/neighbourhoods.h"

namespace pcl {
namespace kss {

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

/** \brief How far the points of a cloud lie off its surface: the standard deviation, by
 * the distances of the nearer neighbours from each point's plane, so that the other skin
 * of a thin wall does not pass for noise.
 * \param[in] points at least one
 * \param[in] neighbourhoods of them
 * \param[in] normals of them
 * \param[in] threads 0: as many as there are cores
 */
float
noiseAbout(const Points& points,
           const Neighbourhoods& neighbourhoods,
           const Points& normals,
           unsigned int threads);

} // namespace kss
} // namespace pcl
