/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "mesh_sampling.h"

#include "fields.h"
#include "mesh_orientation.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace tool {
namespace {

/** A number in [0, 1); unlike std::uniform_real_distribution the same one with every
 * standard library.
 */
double
random(std::mt19937_64& generator)
{
  return static_cast<double>(generator() >> 11) * 0x1p-53;
}

} // namespace

MeshSampler::MeshSampler(const Geometry& mesh)
: MeshSampler(mesh, positionsOf(mesh), std::vector<bool>(mesh.faces.size()))
{
}

MeshSampler::MeshSampler(const Geometry& mesh,
                         Points points,
                         const std::vector<bool>& turned)
: points_(std::move(points))
{
  triangles_.reserve(mesh.faces.size());
  area_up_to_.reserve(mesh.faces.size());
  double total = 0.0;
  for (std::size_t face = 0; face < mesh.faces.size(); ++face) {
    const auto& vertices = mesh.faces[face].vertices;
    const auto vertex = [&](std::size_t i) {
      return vertices[turned[face] ? vertices.size() - 1 - i : i];
    };
    for (std::size_t i = 2; i < vertices.size(); ++i) { // as a fan of triangles
      const Triangle triangle{vertex(0), vertex(i - 1), vertex(i)};
      const auto corner = cornersOf(triangle);
      const double area =
          0.5 * (corner[1] - corner[0]).cross(corner[2] - corner[0]).norm();
      if (!std::isfinite(area))
        continue;
      triangles_.push_back(triangle);
      area_up_to_.push_back(total += area);
    }
  }
}

SurfacePoint
MeshSampler::draw(std::mt19937_64& generator) const
{
  const auto chosen = std::upper_bound(area_up_to_.begin(), area_up_to_.end(),
                                       area() * random(generator));
  const auto corner = cornersOf(triangles_[std::min<std::size_t>(
      chosen - area_up_to_.begin(), triangles_.size() - 1)]);
  // The square root makes the distribution even over the triangle.
  const double u = std::sqrt(random(generator));
  const double v = random(generator);
  return {(1.0 - u) * corner[0] + u * (1.0 - v) * corner[1] + u * v * corner[2],
          (corner[1] - corner[0]).cross(corner[2] - corner[0]).normalized()};
}

SurfacePoints
sampleMesh(const Geometry& mesh, std::size_t number)
{
  Points points = positionsOf(mesh);
  const std::vector<bool> turned = facesTurnedInwards(mesh, points);
  const MeshSampler sampler(mesh, std::move(points), turned);
  if (!(sampler.area() > 0.0))
    return {positionsOf(mesh), normalsOf(mesh)};

  std::mt19937_64 generator(0);
  SurfacePoints samples;
  for (std::size_t i = 0; i < number; ++i) {
    const SurfacePoint sample = sampler.draw(generator);
    samples.positions.push_back(sample.position);
    samples.normals.push_back(sample.normal);
  }
  return samples;
}

pcl::PCLPointCloud2
cloudOf(const SurfacePoints& points)
{
  std::vector<std::string> names{"x", "y", "z"};
  if (!points.normals.empty())
    names.insert(names.end(), {"normal_x", "normal_y", "normal_z"});
  std::vector<double> numbers;
  numbers.reserve(points.positions.size() * names.size());
  for (std::size_t i = 0; i < points.positions.size(); ++i) {
    numbers.insert(numbers.end(), points.positions[i].begin(),
                   points.positions[i].end());
    if (!points.normals.empty())
      numbers.insert(numbers.end(), points.normals[i].begin(), points.normals[i].end());
  }
  return cloudOfDoubles(numbers, names);
}

} // namespace tool
