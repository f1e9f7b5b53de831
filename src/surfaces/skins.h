/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "geometry/oriented_points.h"
#include "geometry/scale_range.h"
#include "geometry/similarity.h"
#include "geometry/turns.h"

#include <optional>

namespace pcl {
namespace kss {

/** \brief Look for a skin beside the one that a pose has laid the source on, or between
 * two of which it has come to rest: of a thin wall, or of a part within a hull.
 *
 * ICP does not get from one to the other. Here the source is shifted, turned and scaled
 * a little along each principal direction of what it says about the pose (see
 * evidenceAt()), as far as nearest points reach.
 * \param[in] source
 * \param[in] target in the frame that the pose leads to
 * \param[in] T_target_source where ICP has come to rest
 * \param[in] scales that the pose may have
 * \param[in] turns the axes that it may be turned about
 * \return where surfaces explain many more of the source's points; none: nowhere near
 */
std::optional<Similarity>
skinBeside(const OrientedPoints& source,
           const OrientedPoints& target,
           const Similarity& T_target_source,
           const ScaleRange& scales,
           const Turns& turns);

} // namespace kss
} // namespace pcl
