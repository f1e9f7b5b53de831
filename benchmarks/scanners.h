/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "clouds.h"
#include "ray_casting.h"

#include <Eigen/Geometry>

/** Scanners, which see a place from one side, with shadows, dense near by and sparse
 * far away. All clouds are in the frames of the scanners.
 */
namespace benchmarks {

/** \brief One sweep of a lidar of 32 rings that spins, z up: ranges up to 70 m, off by
 * 2 cm.
 */
Cloud::Ptr
sweep(const Place& place, const Eigen::Isometry3d& scanner, unsigned int seed);

/** \brief One depth image of 640 x 480 pixels, x to the right, y down. Depths are off
 * by 1.5 mm at a metre, and by the square of it.
 * \param[in] step takes every so many pixels, either way
 */
Cloud::Ptr
photograph(const Place& place,
           const Eigen::Isometry3d& camera,
           unsigned int seed,
           int step = 1);

/** \brief A scan all around by a scanner on a tripod, z up: ranges up to 20 m, off by
 * 2 mm.
 */
Cloud::Ptr
panorama(const Place& place, const Eigen::Isometry3d& scanner, unsigned int seed);

/** \brief A camera that looks at something, upright. */
Eigen::Isometry3d
lookAt(const Eigen::Vector3d& eye, const Eigen::Vector3d& goal);

} // namespace benchmarks
