/*
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * How much of what two clouds say about a pose speaks for it.
 */

#pragma once

#include <pcl/registration/kss/evidence.h>

#include "geometry/oriented_points.h"
#include "geometry/similarity.h"

namespace pcl {
namespace kss {

/** \brief Points of each cloud that speak where a pose is judged. */
constexpr Eigen::Index most_speakers = 4000;

/** \brief Weigh what two clouds say about a pose.
 *
 * A point is explained by a surface near it, within the noise, whose normal agrees. It
 * counts by what it says about the pose: its row J of the point-to-plane distances'
 * normal equations, [n, (x - c) x n / r] and, where the scale is free, n . (x - c) / r.
 * With H = sum of J'J, the share of H that explained points bring in the direction
 * where it is least is the smallest generalised eigenvalue of (H_explained, H_all).
 * \param[in] source
 * \param[in] target in the same frame as the pose leads to
 * \param[in] T_target_source the pose
 * \param[in] scale_is_free whether the scale is part of what has to be explained
 * \param[in] most points of each cloud that speak
 */
Evidence
evidenceAt(const OrientedPoints& source,
           const OrientedPoints& target,
           const Similarity& T_target_source,
           bool scale_is_free,
           Eigen::Index most = most_speakers);

} // namespace kss
} // namespace pcl
