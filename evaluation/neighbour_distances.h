/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "method.h"
#include "surface.h"

/** What the neighbours of a point tell about a cloud. */
namespace evaluation {

/** \brief The mean distance of points to their k nearest neighbours.
 * \param[in] step 1: of all points; otherwise of every so-manieth
 */
double
meanNeighbourDistance(const Cloud::ConstPtr& cloud, int k, std::size_t step);

/** \brief The paper's l_k: the mean distance of all points to their k = 12 nearest
 * neighbours.
 */
double
meanNeighbourDistance(const SurfacePoints& points);

/** \brief Set the normals of all points from their 12 nearest neighbours; away from the
 * middle.
 */
void
estimateNormals(SurfacePoints& points);

} // namespace evaluation
