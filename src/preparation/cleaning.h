/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/detail/points.h>

#include "geometry/neighbourhoods.h"

namespace pcl {
namespace kss {

/** \brief Leave out copies of points: they would pass for points without any spacing.
 * \param[in] cloud any number of points
 * \return the points, each once
 */
Points
withoutCopies(const Points& cloud);

/** \brief Neighbours that the points of a clean cloud know. */
constexpr int known_neighbours = 12;

/** \brief Leave out stray points: those that farthest point sampling would seek out.
 *
 * A point goes that has much more space around it than its neighbours have, or that is
 * sparse and whose neighbours fill space rather than lie on a surface. Sparse regions
 * of a surface stay.
 * \param[in] cloud any number of points
 * \param[in] threads 0: as many as there are cores; the result does not depend on it
 * \return the other points; all where most would have to go. Their neighbours come with
 * them: at least \ref known_neighbours, where there are as many points.
 */
Surface
withoutStrayPoints(const Points& cloud, unsigned int threads);

/** \brief Whether noise is so heavy that the points fill space instead of lying on a
 * surface.
 * \param[in] surface points that know sixteen neighbours, as withoutStrayPoints()
 * leaves them
 * \param[in] threads 0: as many as there are cores
 */
bool
isNoisy(const Surface& surface, unsigned int threads);

/** \brief Average heavy noise away.
 *
 * Each cloud becomes at most \a samples points, each the mean of the points around it.
 * The radius, a fraction of the cloud's root mean square radius, is the same for both,
 * so that both lose the same detail: the smallest that makes surfaces of them again, a
 * quarter at most.
 * \param[in,out] source a cloud
 * \param[in,out] target a cloud
 * \param[in] samples how many means to take at most
 * \param[in] threads 0: as many as there are cores; the result does not depend on it
 */
void
averageNoise(Points& source,
             Points& target,
             unsigned int samples,
             unsigned int threads);

} // namespace kss
} // namespace pcl
