/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/detail/points.h>

namespace kss_test {

/** \brief Points about an origin, as the stages take them. */
inline pcl::kss::LocalCloud
local(const pcl::kss::Points& points,
      const Eigen::Vector3d& origin = Eigen::Vector3d::Zero())
{
  pcl::kss::LocalCloud cloud;
  cloud.points = points;
  cloud.origin = origin;
  return cloud;
}

} // namespace kss_test
