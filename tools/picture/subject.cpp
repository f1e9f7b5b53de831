/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "subject.h"

#include "io/fields.h"
#include "io/mesh_sampling.h"

#include <pcl/registration/kss/detail/cloud_conversion.h>

#include <algorithm>
#include <filesystem>

namespace tool {
namespace {

/** A number with commas between thousands. */
std::string
grouped(std::size_t number)
{
  std::string text = std::to_string(number);
  for (int place = static_cast<int>(text.size()) - 3; place > 0; place -= 3)
    text.insert(static_cast<std::size_t>(place), ",");
  return text;
}

/** Those that are finite, and not so far out that nothing else could be seen. */
Points
visible(const Points& points)
{
  constexpr double FARTHEST = 1e18; // its square is a float
  pcl::Indices finite;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (points[i].allFinite() && points[i].cwiseAbs().maxCoeff() < FARTHEST)
      finite.push_back(static_cast<pcl::index_t>(i));
  if (finite.empty())
    return {Eigen::Vector3d::Zero()}; // a dot says that there is nothing to see
  const auto place = [&](pcl::index_t i) {
    return points[static_cast<std::size_t>(i)];
  };
  const pcl::kss::Bulk bulk = pcl::kss::bulkOf(place, finite);
  Points visible;
  visible.reserve(finite.size());
  for (const pcl::index_t i : finite)
    if (bulk.holds(place(i)))
      visible.push_back(place(i));
  return visible;
}

} // namespace

Subject
subjectOf(const std::string& path, const Geometry& geometry, unsigned int seed)
{
  const std::string name = std::filesystem::path(path).filename().string();
  if (!geometry.faces.empty()) {
    const MeshSampler sampler(geometry);
    if (sampler.area() > 0.0) {
      Subject mesh{name + ", " + grouped(geometry.faces.size()) + " faces", {}};
      mesh.points.reserve(DRAWN_POINTS);
      std::mt19937_64 generator(seed);
      for (std::size_t i = 0; i < DRAWN_POINTS; ++i)
        mesh.points.push_back(sampler.draw(generator).position);
      return mesh;
    }
  }
  return {name + ", " + grouped(numberOfPoints(geometry.cloud)) + " points",
          visible(positionsOf(geometry))};
}

Points
drawnOf(const Points& points)
{
  if (points.size() <= DRAWN_POINTS)
    return points;
  pcl::Indices all(points.size());
  std::iota(all.begin(), all.end(), 0);
  Points drawn;
  drawn.reserve(DRAWN_POINTS);
  for (const pcl::index_t i : pcl::kss::spread(all, DRAWN_POINTS))
    drawn.push_back(points[static_cast<std::size_t>(i)]);
  return drawn;
}

Points
moved(const Points& points, const Eigen::Matrix4d& transformation)
{
  const Eigen::Matrix3d linear = transformation.topLeftCorner<3, 3>();
  const Eigen::Vector3d shift = transformation.topRightCorner<3, 1>();
  Points moved;
  moved.reserve(points.size());
  for (const auto& point : points)
    moved.emplace_back(linear * point + shift);
  return moved;
}

} // namespace tool
