/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "local_frame.h"

namespace tool {

Eigen::Vector3d
localOrigin(const Points& points)
{
  return boundingBox(points).center();
}

Eigen::Matrix4d
fromLocalFrames(const Eigen::Matrix4d& local,
                const Eigen::Vector3d& source_origin,
                const Eigen::Vector3d& target_origin)
{
  Eigen::Matrix4d transformation = local;
  transformation.topRightCorner<3, 1>() +=
      target_origin - local.topLeftCorner<3, 3>() * source_origin;
  return transformation;
}

} // namespace tool
