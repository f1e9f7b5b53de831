/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "format_writers.h"
#include "text_row.h"

#include <boost/algorithm/string/predicate.hpp>

#include <array>
#include <string>

namespace tool {
namespace {

void
writeVector(std::ostream& stream, const Eigen::Vector3d& vector)
{
  const Eigen::Vector3f narrow = vector.cast<float>();
  stream.write(reinterpret_cast<const char*>(narrow.data()), 3 * sizeof(float));
}

using Triangle = std::array<Eigen::Vector3d, 3>;

/** Call a function with each triangle of the faces. */
template <typename Function>
void
forEachTriangle(const Geometry& geometry, Function&& function)
{
  const Points points = positionsOf(geometry);
  for (const auto& face : geometry.faces)
    for (std::size_t i = 2; i < face.vertices.size(); ++i)
      function(Triangle{points[face.vertices[0]], points[face.vertices[i - 1]],
                        points[face.vertices[i]]});
}

Eigen::Vector3d
normalOf(const Triangle& triangle)
{
  return (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]).normalized();
}

/** The name of the solid, or the text in the header. */
std::string
nameOf(const Geometry& geometry)
{
  return geometry.comments.size() == 1 ? geometry.comments[0] : std::string();
}

void
writeBinary(std::ostream& stream, const Geometry& geometry)
{
  std::uint32_t triangles = 0;
  for (const auto& face : geometry.faces)
    if (face.vertices.size() >= 3)
      triangles += static_cast<std::uint32_t>(face.vertices.size() - 2);

  std::array<char, 80> header{};
  const std::string name = nameOf(geometry);
  if (!boost::algorithm::istarts_with(name, "solid")) // which is how text starts
    name.copy(header.data(), header.size());
  stream.write(header.data(), header.size());
  stream.write(reinterpret_cast<const char*>(&triangles), sizeof triangles);
  forEachTriangle(geometry, [&](const Triangle& triangle) {
    writeVector(stream, normalOf(triangle));
    for (const auto& corner : triangle)
      writeVector(stream, corner);
    stream.write("\0\0", 2);
  });
}

void
writeFacets(std::ostream& stream, const Geometry& geometry)
{
  const std::string name = nameOf(geometry);
  const auto line = [&](const char* words, const Eigen::Vector3d& vector) {
    Row row(words);
    for (const double number : vector)
      row.addNumber(number);
    row.writeTo(stream);
  };
  stream << "solid " << name << '\n';
  forEachTriangle(geometry, [&](const Triangle& triangle) {
    line("facet normal", normalOf(triangle));
    stream << "outer loop\n";
    for (const auto& corner : triangle)
      line("vertex", corner);
    stream << "endloop\nendfacet\n";
  });
  stream << "endsolid " << name << '\n';
}

} // namespace

void
writeSTL(std::ostream& stream, const Geometry& geometry)
{
  // Bytes are floats, and text has all digits.
  const bool is_coarse =
      !hasSinglePrecision(geometry) && singlePrecisionIsCoarse(boundingBox(geometry));
  if (geometry.storage == Storage::TEXT || is_coarse)
    writeFacets(stream, geometry);
  else
    writeBinary(stream, geometry);
}

} // namespace tool
