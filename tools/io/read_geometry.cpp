/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "read_geometry.h"

#include "fields.h"
#include "file_format.h"
#include "format_readers.h"
#include "text_encoding.h"
#include "vector_field.h"

#include <boost/algorithm/string/case_conv.hpp>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <new>
#include <sstream>
#include <stdexcept>

namespace tool {
namespace {

/** Differences of such numbers are floats, too. */
constexpr double LARGEST_COORDINATE = 1e38;

std::string
inShort(double number)
{
  std::ostringstream text;
  text << number;
  return text.str();
}

/** Open a file for reading. What is no file is refused before it is opened: pipes would
 * block there, and some devices never end. */
std::ifstream
open(const std::string& path)
{
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status))
    throw std::runtime_error(error ? error.message() : "No such file or directory");
  if (!std::filesystem::is_regular_file(status))
    throw std::runtime_error("is not a regular file");
  errno = 0;
  std::ifstream stream(path, std::ios::binary);
  if (!stream)
    throw std::runtime_error(std::strerror(errno));
  if (stream.peek() == std::ifstream::traits_type::eof())
    throw std::runtime_error("the file is empty");
  return stream;
}

Geometry
readAs(FileFormat format, std::istream& stream)
{
  switch (format) {
  case FileFormat::PCD:
    return readPCD(stream);
  case FileFormat::PLY:
    return readPLY(stream);
  case FileFormat::OFF:
    return readOFF(stream);
  case FileFormat::OBJ:
    return readOBJ(stream);
  case FileFormat::STL:
    return readSTL(stream);
  case FileFormat::PTX:
    return readPTX(stream);
  case FileFormat::TEXT:
  case FileFormat::CSV:
  case FileFormat::PTS:
    return readText(stream, format);
  }
  throw std::logic_error("format without a reader");
}

/** Name positions and normals as PCL does, whatever the file calls them: X, or nx. */
void
nameVectors(pcl::PCLPointCloud2& cloud)
{
  const auto rename = [&](const std::array<const char*, 3>& names, const auto& others) {
    std::array<pcl::PCLPointField*, 3> fields{};
    for (std::size_t i = 0; i < 3; ++i)
      for (auto& field : cloud.fields) {
        if (field.name == names[i])
          return;
        const std::string name = boost::algorithm::to_lower_copy(field.name);
        if (!fields[i] && (name == names[i] || name == others[i]))
          fields[i] = &field;
      }
    if (std::count(fields.begin(), fields.end(), nullptr) == 0)
      for (std::size_t i = 0; i < 3; ++i)
        fields[i]->name = names[i];
  };
  rename(VectorField::POSITION, VectorField::POSITION);
  rename(VectorField::NORMAL, std::array<const char*, 3>{"nx", "ny", "nz"});
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

  const VectorField position(cloud, VectorField::POSITION);
  const std::size_t points = numberOfPoints(cloud);
  bool has_finite = false;
  for (std::size_t i = 0; i < points; ++i) {
    const Eigen::Vector3d point = position.get(&cloud.data[i * cloud.point_step]);
    for (const double coordinate : point)
      if (std::isfinite(coordinate) && std::abs(coordinate) > LARGEST_COORDINATE)
        throw std::runtime_error(
            "point " + std::to_string(i + 1) + " has the coordinate " +
            inShort(coordinate) +
            ", which single precision cannot carry; remove the point, or, if the file "
            "names the wrong types for its data, correct them");
    has_finite = has_finite || point.allFinite();
  }
  if (!has_finite)
    throw std::runtime_error("has no finite points");

  for (const auto& face : geometry.faces)
    for (const auto vertex : face.vertices)
      if (static_cast<std::size_t>(vertex) >= points)
        throw std::runtime_error("a face refers to point " + std::to_string(vertex) +
                                 ", but there are only " + std::to_string(points));
}

} // namespace

Geometry
readGeometry(const std::string& path)
{
  try {
    std::ifstream file = open(path);
    const auto decoded = decodedUTF16(file);
    std::istream& stream = decoded ? *decoded : file;
    Geometry geometry = readAs(fileFormatOf(path, stream), stream);
    if (file.bad())
      throw std::runtime_error("cannot be read to its end");
    nameVectors(geometry.cloud);
    check(geometry);
    return geometry;
  }
  catch (const std::bad_alloc&) {
    throw std::runtime_error(path + ": needs more memory than there is");
  }
  catch (const std::exception& problem) {
    const std::string message = problem.what();
    throw std::runtime_error(message.find(path + ": ") == 0 ? message
                                                            : path + ": " + message);
  }
}

} // namespace tool
