/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/detail/points.h>

namespace pcl {
namespace kss {

/** \brief The first points of a cloud, each with what it stands for: the points that it
 * is the nearest of them to.
 *
 * A row per probe: x, y, z; the share of the cloud it stands for; how far that reaches
 * from it; and the mean distance of that, as a share of the reach. As many rows as fill
 * vectors of eight; those too many stand for nothing.
 */
using Probes = Eigen::Matrix<float, Eigen::Dynamic, 6>;

/** \param[in] cloud at least one point
 * \param[in] number of probes
 */
Probes
probesOf(const Points& cloud, Eigen::Index number);

} // namespace kss
} // namespace pcl
