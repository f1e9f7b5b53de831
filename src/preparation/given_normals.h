/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/detail/points.h>

#include "geometry/neighbourhoods.h"

namespace pcl {
namespace kss {

/** \brief Let the normals that came with a cloud take the place of those that were
 * found of its points, where they are normals of that surface.
 * \param[in] cloud as it came
 * \param[in] surface some of its points
 * \param[in,out] normals found, a column per point of the surface, of any sign; a point
 * without a normal of its own keeps the one found, turned as its neighbour's
 * \return whether the signs now tell which side is outside; see sidesAreConsistent()
 */
bool
takeGivenNormals(const LocalCloud& cloud, const Surface& surface, Points& normals);

} // namespace kss
} // namespace pcl
