/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "scan_points.h"

#include "io/fields.h"
#include "io/mesh_sampling.h"
#include "io/vector_field.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace tool {
namespace {

/** The box that the middle three fifths of points lie in along each axis. */
Eigen::AlignedBox3d
middleOf(const Points& points)
{
  Eigen::AlignedBox3d box;
  if (points.empty())
    return box;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> numbers;
    for (const Eigen::Vector3d& point : points)
      numbers.push_back(point[axis]);
    std::sort(numbers.begin(), numbers.end());
    box.min()[axis] = numbers[numbers.size() / 5];
    box.max()[axis] = numbers[numbers.size() - 1 - numbers.size() / 5];
  }
  return box;
}

} // namespace

pcl::PCLPointCloud2
pointsOf(const Geometry& scan, std::size_t samples)
{
  return scan.faces.empty() ? scan.cloud : cloudOf(sampleMesh(scan, samples));
}

ScanLook
lookAt(const pcl::PCLPointCloud2& cloud, const Eigen::Matrix4d& pose, std::size_t drawn)
{
  const Eigen::Affine3d placed(pose);
  const VectorField positions(cloud, VectorField::POSITION);
  ScanLook look;
  look.extras.normals = VectorField(cloud, VectorField::NORMAL).isFloatingPoint();
  look.extras.colours = look.extras.intensity = false;
  for (const auto& field : cloud.fields) {
    look.extras.colours = look.extras.colours || isPackedColour(field);
    look.extras.intensity = look.extras.intensity || field.name == "intensity";
  }
  const std::size_t number = numberOfPoints(cloud);
  // one of each so many points, at uneven steps: scans have rows
  const double step =
      drawn == 0 ? 0.0 : std::max(1.0, static_cast<double>(number) / drawn);
  double next = 0.0;
  std::size_t chosen = 0;
  constexpr std::size_t SAMPLED = 2000; // tell where most of the points lie
  const std::size_t stride = number / SAMPLED + 1;
  Points sampled;
  for (std::size_t i = 0; i < number; ++i) {
    const bool is_drawn = drawn > 0 && static_cast<double>(i) >= next;
    if (is_drawn) {
      ++chosen;
      const double aside = std::fmod(0.618033988749895 * chosen, 1.0);
      next = step * (chosen + (step > 1.0 ? aside : 0.0));
    }
    const Eigen::Vector3d point =
        placed * positions.get(&cloud.data[i * cloud.point_step]);
    if (!point.allFinite())
      continue;
    if (look.points++ % stride == 0)
      sampled.push_back(point);
    if (is_drawn)
      look.drawn.push_back(point);
  }
  look.box = middleOf(sampled);
  return look;
}

} // namespace tool
