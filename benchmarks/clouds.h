/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <Eigen/Geometry>

#include <cstddef>

/** What is registered: clouds made here, so that the benchmarks need no data. */
namespace benchmarks {

using Cloud = pcl::PointCloud<pcl::PointXYZ>;

/** \brief Two samplings of one surface, and how the one lies to the other. */
struct Pair {
  Cloud::Ptr source, target;
  Eigen::Affine3d truth; ///< rigid; maps the source to the target
};

/** \brief Sample the surface, evenly by area: a closed one with bumps and dents, and
 * without any symmetry. Gaussian noise of 0.3 mean point spacings is added.
 * \param[in] size number of points
 * \param[in] seed other points with every seed, as if the surface had been scanned anew
 */
Cloud::Ptr
sampleSurface(std::size_t size, unsigned int seed);

/** \brief Two samplings, the source turned by 140 degrees and moved by more than its
 * diameter. They are made once for every size and stay.
 */
const Pair&
pairOf(std::size_t size);

/** \brief A second source for the same target: another sampling in another pose. */
const Pair&
secondPairOf(std::size_t size);

} // namespace benchmarks
