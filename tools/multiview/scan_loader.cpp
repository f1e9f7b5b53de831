/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "scan_loader.h"

#include "io/fields.h"
#include "io/vector_field.h"
#include "scan_points.h"

namespace tool {

std::shared_ptr<const pcl::kss::Cloud>
cloudOf(const Geometry& scan, std::size_t samples)
{
  const pcl::PCLPointCloud2 points = pointsOf(scan, samples);
  const VectorField positions(points, VectorField::POSITION);
  const VectorField normals(points, VectorField::NORMAL);
  const std::size_t size = numberOfPoints(points);
  const auto cloud = std::make_shared<pcl::kss::Cloud>();
  cloud->points.resize(3, size);
  if (normals.exists())
    cloud->normals.resize(3, size);
  for (std::size_t i = 0; i < size; ++i) {
    const std::uint8_t* const bytes = &points.data[i * points.point_step];
    cloud->points.col(i) = positions.get(bytes);
    if (normals.exists())
      cloud->normals.col(i) = normals.get(bytes).cast<float>();
  }
  return cloud;
}

} // namespace tool
