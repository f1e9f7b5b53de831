/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/detail/points.h>
#include <pcl/registration/kss/settings.h>

#include "geometry/fingerprint.h"
#include "geometry/neighbourhoods.h"
#include "geometry/tangent_planes.h"
#include "preparation/farthest_points.h"

namespace pcl {
namespace kss {

/** \brief A cloud made ready for any other. */
struct PreparedCloud {
  /** \brief What tells the cloud as it came. */
  Fingerprint fingerprint = {};
  /** \brief Where its frame lies. */
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  /** \brief Its points, clean, and no more than refinement and judgement need. */
  Surface surface;
  /** \brief The same, as dense as the cloud is: what judges poses. */
  Surface dense;
  /** \brief Its planes at these points. */
  TangentPlanes planes;
  /** \brief As many of them in farthest order as the simplification may need. */
  FarthestOrder order;
  /** \brief Whether heavy noise has to be averaged away. */
  bool is_noisy = false;
};

/** \brief Thin a cloud out, clean it and order its points. */
PreparedCloud
prepared(const LocalCloud& cloud,
         const Fingerprint& fingerprint,
         const Settings& settings);

/** \brief Average the noise of two clouds away; see averageNoise(). */
void
averageNoise(PreparedCloud& source, PreparedCloud& target, const Settings& settings);

/** \brief Both clouds simplified to the same number of points, which pre-shape space
 * asks for: as many as the settings want, or as both can spread evenly.
 */
std::pair<Points, Points>
simplified(const PreparedCloud& source,
           const PreparedCloud& target,
           const Settings& settings);

} // namespace kss
} // namespace pcl
