/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/detail/points.h>
#include <pcl/registration/kss/settings.h>

#include "geometry/neighbourhoods.h"
#include "preparation/farthest_points.h"

namespace pcl {
namespace kss {

/** \brief A cloud of no more points than these is taken as it is: evenness would leave
 * too little of it to tell a shape by. */
constexpr std::size_t fewest_samples = 64;

/** \brief Any points: what other densities are measured against. */
constexpr auto random_points = static_cast<Density>(-1);

/** \brief How many points of a cloud can be spread evenly.
 *
 * Where a cloud is so sparse that its own spacing exceeds that of as many even samples,
 * fewer have to do: no choice among its points could be even.
 * \param[in] order the points asked for
 * \param[in] neighbourhoods of the cloud
 * \return no more than were asked for, and no less than the smaller of that and
 * \ref fewest_samples
 */
std::size_t
evenSampleSize(const FarthestOrder& order, const Neighbourhoods& neighbourhoods);

/** \brief Simplify a cloud to k of its points (Sec. III-B of the paper).
 *
 * Density::UNIFORM is farthest point sampling: all over the cloud, points lie equally
 * far apart.
 *
 * Density::PAPER gives each voxel of the edge (e6) the share of samples that it has of
 * the points (e5). Voxels are sampled in eight rounds, none of which holds two adjacent
 * ones; within a voxel the point farthest from all samples so far, those of the
 * adjacent voxels included, is taken next.
 *
 * random_points draws points, the same ones at every call.
 *
 * \param[in] cloud a cloud of any size
 * \param[in] k the number of samples
 * \param[in] density how the samples are spread
 * \param[in] threads 0: as many as there are cores; the result does not depend on it
 * \return exactly k points in farthest order (see FarthestOrder); all points where the
 * cloud has no more
 */
Points
simplify(const Points& cloud, std::size_t k, Density density, unsigned int threads);

/** \brief Thin a cloud out to at most so many points, quickly and about evenly: one
 * point for each cell of a grid.
 * \param[in] cloud a cloud of any size; as it is where it has no more points
 * \param[in] most at least 1
 */
Points
thinned(const Points& cloud, std::size_t most);

} // namespace kss
} // namespace pcl
