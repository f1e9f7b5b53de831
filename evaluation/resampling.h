/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "protocol.h"
#include "surface.h"

namespace evaluation {

/** \brief How many points it takes for so many to be left with another density. */
std::size_t
pointsToResample(std::size_t number, Resampling resampling);

/** \brief At most so many of the points, or near them, with a density of their own.
 * \throws std::runtime_error where this program was built without what it takes
 */
SurfacePoints
resampled(const SurfacePoints& points,
          std::size_t number,
          Resampling resampling,
          Random& random);

/** \brief Whether this program was built with CGAL, for Resampling::WLOP. */
bool
hasWLOP();

/** \brief Weighted locally optimal projection: fewer points, spread evenly, each with
 * the normal of the nearest original point.
 */
SurfacePoints
simplifiedByWLOP(const SurfacePoints& points, std::size_t number);

} // namespace evaluation
