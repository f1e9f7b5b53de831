/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "local_frame.h"

#include "io/fields.h"
#include "io/vector_field.h"

#include <pcl/registration/kss/detail/bulk.h>
#include <pcl/registration/kss/detail/cloud_conversion.h>

namespace tool {

Eigen::Vector3d
localOrigin(const pcl::PCLPointCloud2& cloud)
{
  const VectorField position(cloud, VectorField::POSITION);
  const auto at = [&](std::size_t i) {
    return position.get(&cloud.data[i * cloud.point_step]);
  };
  pcl::Indices finite;
  finite.reserve(numberOfPoints(cloud));
  for (std::size_t i = 0; i < numberOfPoints(cloud); ++i)
    if (at(i).allFinite())
      finite.push_back(static_cast<pcl::index_t>(i));
  // the middle of the box is wherever a point far away from all others puts it
  const pcl::kss::Bulk bulk = pcl::kss::bulkOf(at, finite);
  pcl::kss::throwIfTooWide(bulk);
  return bulk.middle;
}

Eigen::Matrix4d
toLocalFrames(const Eigen::Matrix4d& transformation,
              const Eigen::Vector3d& source_origin,
              const Eigen::Vector3d& target_origin)
{
  return fromLocalFrames(transformation, -source_origin, -target_origin);
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
