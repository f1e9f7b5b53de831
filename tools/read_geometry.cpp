/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "read_geometry.h"

#include "fields.h"
#include "file_format.h"
#include "format_readers.h"
#include "vector_field.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <new>
#include <stdexcept>

namespace tool {
namespace {

void
checkReadable(const std::string& path)
{
  errno = 0;
  std::ifstream stream(path, std::ios::binary);
  if (!stream)
    throw std::runtime_error(std::strerror(errno));
  if (std::filesystem::is_directory(path))
    throw std::runtime_error("is a directory");
  if (stream.peek() == std::ifstream::traits_type::eof())
    throw std::runtime_error("the file is empty");
}

Geometry
readAs(FileFormat format, const std::string& path)
{
  switch (format) {
  case FileFormat::PCD:
    return readPCD(path);
  case FileFormat::PLY:
    return readPLY(path);
  case FileFormat::OFF:
    return readOFF(path);
  case FileFormat::OBJ:
  case FileFormat::STL:
    return readWithAssimp(path);
  case FileFormat::TEXT:
    return readText(path);
  }
  throw std::logic_error("format without a reader");
}

/** What all formats can get wrong. */
void
check(const Geometry& geometry)
{
  const auto& cloud = geometry.cloud;
  for (const char* name : VectorField::POSITION)
    if (!findField(cloud, name))
      throw std::runtime_error(std::string("has no coordinate ") + name);
  if (numberOfPoints(cloud) == 0)
    throw std::runtime_error("holds no points");
  if (cloud.data.size() != numberOfPoints(cloud) * cloud.point_step)
    throw std::runtime_error("the file is damaged or incomplete");

  const Points points = positionsOf(geometry);
  if (std::none_of(points.begin(), points.end(),
                   [](const Eigen::Vector3d& point) { return point.allFinite(); }))
    throw std::runtime_error("has no finite points");

  for (const auto& face : geometry.faces)
    for (const auto vertex : face.vertices)
      if (static_cast<std::size_t>(vertex) >= points.size())
        throw std::runtime_error("a face refers to point " + std::to_string(vertex) +
                                 ", but there are only " +
                                 std::to_string(points.size()));
}

} // namespace

Geometry
readGeometry(const std::string& path)
{
  const FileFormat format = fileFormatOf(path);
  try {
    checkReadable(path);
    Geometry geometry = readAs(format, path);
    check(geometry);
    return geometry;
  }
  catch (const std::bad_alloc&) {
    throw std::runtime_error(path + ": needs more memory than there is");
  }
  catch (const std::exception& problem) {
    throw std::runtime_error(path + ": " + problem.what());
  }
}

} // namespace tool
