/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/points.h>
#include <pcl/registration/kss/settings.h>

namespace pcl {
namespace kss {

/** \brief How many of \a k points a cloud can hold and still be evenly covered.
 *
 * Where a cloud is so sparse that its own spacing exceeds that of k even samples, k has
 * to shrink: no choice among its points could be even.
 * \param[in] cloud a cloud of at least one point
 * \param[in] k the number of points wished for
 * \param[in] threads 0: as many as there are cores
 * \return at most k, and no less than the smaller of k and 64
 */
unsigned int
evenSampleSize(const Points& cloud, unsigned int k, unsigned int threads);

/** \brief Simplify a cloud to k of its points: parallel farthest point sampling in
 * voxels (Sec. III-B of the paper).
 *
 * Voxels of the edge (e6) are sampled in eight rounds, none of which holds two adjacent
 * voxels; within a voxel the point farthest from all samples so far, those of the
 * adjacent voxels included, is taken next. Density::PAPER gives each voxel the share of
 * samples that it has of the points (e5). Density::UNIFORM stops in all voxels at a
 * common distance, found such that k samples come out: a share by occupied area.
 *
 * \param[in] cloud a cloud of any size
 * \param[in] k the number of samples
 * \param[in] density how the samples are spread
 * \param[in] threads 0: as many as there are cores; the result does not depend on it
 * \return exactly k points; all points where the cloud has no more (of copies,
 * Density::UNIFORM takes one)
 */
Points
simplify(const Points& cloud, unsigned int k, Density density, unsigned int threads);

/** \brief Thin a cloud out to at most so many points, quickly and about evenly: one
 * point for each cell of a grid. \param[in] cloud a cloud of any size; as it is where
 * it has no more points \param[in] most at least 1
 */
Points
thinned(const Points& cloud, unsigned int most);

/** \brief Order points such that any leading part of them covers the cloud evenly: each
 * is the farthest from those before it; the first is the nearest to their mean.
 * \param[in] cloud at least one point; the time grows with the square of its size
 */
Points
inFarthestOrder(const Points& cloud);

} // namespace kss
} // namespace pcl
