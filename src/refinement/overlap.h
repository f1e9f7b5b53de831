/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/result.h>

#include "geometry/nearest_points.h"
#include "geometry/similarity.h"

#include <Eigen/Geometry>

#include <limits>

namespace pcl {
namespace kss {

/** \brief Measure the overlap at a pose.
 *
 * The tolerance is the spacing of the points, the wider one of the two clouds: a
 * surface covers another sampling of itself that closely, and hardly anything else.
 * \param[in] source points of the source, and their spacing
 * \param[in] target points of the target, and their spacing
 * \param[in] T_target_source the pose
 * \param[in] most points of each cloud that tell, spread over it
 */
Overlap
overlapAt(const NearestPoints& source,
          const NearestPoints& target,
          const Similarity& T_target_source,
          Eigen::Index most = std::numeric_limits<Eigen::Index>::max());

} // namespace kss
} // namespace pcl
