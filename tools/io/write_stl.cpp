/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "format_writers.h"

#include <array>
#include <cstring>

namespace tool {
namespace {

void
writeVector(std::ostream& stream, const Eigen::Vector3d& vector)
{
  const Eigen::Vector3f narrow = vector.cast<float>();
  stream.write(reinterpret_cast<const char*>(narrow.data()), 3 * sizeof(float));
}

} // namespace

void
writeSTL(std::ostream& stream, const Geometry& geometry)
{
  const Points points = positionsOf(geometry);
  std::uint32_t triangles = 0;
  for (const auto& face : geometry.faces)
    if (face.vertices.size() >= 3)
      triangles += static_cast<std::uint32_t>(face.vertices.size() - 2);

  const std::array<char, 80> header{};
  stream.write(header.data(), header.size());
  stream.write(reinterpret_cast<const char*>(&triangles), sizeof triangles);
  for (const auto& face : geometry.faces)
    for (std::size_t i = 2; i < face.vertices.size(); ++i) {
      const auto& a = points[face.vertices[0]];
      const auto& b = points[face.vertices[i - 1]];
      const auto& c = points[face.vertices[i]];
      writeVector(stream, (b - a).cross(c - a).normalized());
      writeVector(stream, a);
      writeVector(stream, b);
      writeVector(stream, c);
      stream.write("\0\0", 2);
    }
}

} // namespace tool
