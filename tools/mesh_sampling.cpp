/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "mesh_sampling.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

namespace tool {
namespace {

using Triangle = std::array<Eigen::Vector3d, 3>;

/** The faces as fans of triangles, without those that have a point that is not finite.
 */
std::vector<Triangle>
trianglesOf(const Geometry& mesh)
{
  const Points points = positionsOf(mesh);
  std::vector<Triangle> triangles;
  for (const auto& face : mesh.faces)
    for (std::size_t i = 2; i < face.vertices.size(); ++i) {
      const Triangle triangle{points[face.vertices[0]], points[face.vertices[i - 1]],
                              points[face.vertices[i]]};
      if (std::all_of(triangle.begin(), triangle.end(),
                      [](const auto& corner) { return corner.allFinite(); }))
        triangles.push_back(triangle);
    }
  return triangles;
}

double
area(const Triangle& triangle)
{
  return 0.5 * (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]).norm();
}

/** A number in [0, 1); unlike std::uniform_real_distribution the same one with every
 * standard library.
 */
double
random(std::mt19937_64& generator)
{
  return static_cast<double>(generator() >> 11) * 0x1p-53;
}

} // namespace

Points
sampleMesh(const Geometry& mesh, std::size_t number)
{
  const auto triangles = trianglesOf(mesh);
  std::vector<double> area_up_to;
  double total = 0.0;
  for (const auto& triangle : triangles)
    area_up_to.push_back(total += area(triangle));
  if (!(total > 0.0))
    return positionsOf(mesh);

  std::mt19937_64 generator(0);
  Points samples(number);
  for (auto& sample : samples) {
    const auto chosen = std::upper_bound(area_up_to.begin(), area_up_to.end(),
                                         total * random(generator));
    const auto& corner = triangles[std::min<std::size_t>(chosen - area_up_to.begin(),
                                                         triangles.size() - 1)];
    // The square root makes the distribution even over the triangle.
    const double u = std::sqrt(random(generator));
    const double v = random(generator);
    sample = (1.0 - u) * corner[0] + u * (1.0 - v) * corner[1] + u * v * corner[2];
  }
  return samples;
}

} // namespace tool
