/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/detail/points.h>

#include "geometry/neighbourhoods.h"

namespace pcl {
namespace kss {

/** \brief Whether the signs of normals tell which side of a surface is outside.
 *
 * Then neighbours agree wherever a surface runs from one to the other, be it round an
 * edge. Normals that were turned towards one viewpoint, as pcl::NormalEstimation does,
 * contradict each other along the silhouette of an object that has a far side: about
 * one pair of neighbours in the square root of the number of points. No more than half
 * of that is allowed.
 * \param[in] points a cloud
 * \param[in] normals unit normals, a column per point; zero: unknown
 * \param[in] neighbourhoods of the cloud
 */
bool
sidesAreConsistent(const Points& points,
                   const Points& normals,
                   const Neighbourhoods& neighbourhoods);

} // namespace kss
} // namespace pcl
