/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "fields.h"
#include "format_writers.h"

#include <pcl/common/io.h>

#include <algorithm>
#include <limits>
#include <map>
#include <string>
#include <variant>
#include <vector>

/** \file
 * PCL 1.13 writes unreadable files for normals in double precision, and meshes of
 * floats only.
 */

namespace tool {
namespace {

/** The type's name in PLY; double for what PLY has no type for. */
std::string
typeName(std::uint8_t datatype)
{
  static const std::map<std::uint8_t, std::string> names{
      {pcl::PCLPointField::INT8, "char"},    {pcl::PCLPointField::UINT8, "uchar"},
      {pcl::PCLPointField::INT16, "short"},  {pcl::PCLPointField::UINT16, "ushort"},
      {pcl::PCLPointField::INT32, "int"},    {pcl::PCLPointField::UINT32, "uint"},
      {pcl::PCLPointField::FLOAT32, "float"}};
  const auto name = names.find(datatype);
  return name == names.end() ? "double" : name->second;
}

/** Names that every PLY reader knows. */
std::string
propertyName(const std::string& field)
{
  if (field == "normal_x" || field == "normal_y" || field == "normal_z")
    return "n" + field.substr(7);
  return field;
}

void
writeProperties(std::ostream& stream, const pcl::PCLPointField& field)
{
  if (isPackedColour(field)) {
    stream << "property uchar red\nproperty uchar green\nproperty uchar blue\n";
    if (field.name == "rgba")
      stream << "property uchar alpha\n";
    return;
  }
  const std::string property =
      "property " + typeName(field.datatype) + ' ' + propertyName(field.name);
  if (field.count <= 1)
    stream << property << '\n';
  else // hardly any reader takes points with lists
    for (pcl::uindex_t i = 0; i < field.count; ++i)
      stream << property << '_' << i << '\n';
}

template <typename T>
void
writeBytes(std::ostream& stream, T value)
{
  stream.write(reinterpret_cast<const char*>(&value), sizeof value);
}

/** Bytes that stand in the file as they do in memory. */
struct Span {
  std::size_t offset, size;
};

/** A part of what is written of a point: bytes, or a field written otherwise. */
using Part = std::variant<Span, pcl::PCLPointField>;

std::vector<Part>
partsOf(const pcl::PCLPointCloud2& cloud)
{
  std::vector<Part> parts;
  for (const auto& field : cloud.fields) {
    if (isPadding(field))
      continue;
    const bool becomes_double = typeName(field.datatype) == "double" &&
                                field.datatype != pcl::PCLPointField::FLOAT64;
    if (isPackedColour(field) || becomes_double) {
      parts.emplace_back(field);
      continue;
    }
    Span* before = parts.empty() ? nullptr : std::get_if<Span>(&parts.back());
    if (before && before->offset + before->size == field.offset)
      before->size += sizeOf(field);
    else
      parts.emplace_back(Span{field.offset, sizeOf(field)});
  }
  return parts;
}

/** Write a field whose bytes in memory are not those in the file. */
void
writeField(std::ostream& stream,
           const pcl::PCLPointField& field,
           const std::uint8_t* point)
{
  if (isPackedColour(field)) {
    const auto colour = getColour(field, point);
    stream.write(reinterpret_cast<const char*>(colour.data()),
                 field.name == "rgba" ? 4 : 3);
  }
  else
    for (std::size_t i = 0; i < std::max<std::size_t>(field.count, 1); ++i)
      writeBytes(stream, getNumber(field, point, i));
}

void
writePoints(std::ostream& stream, const pcl::PCLPointCloud2& cloud)
{
  const auto write = [&](const std::uint8_t* bytes, std::size_t size) {
    stream.write(reinterpret_cast<const char*>(bytes),
                 static_cast<std::streamsize>(size));
  };
  const std::vector<Part> parts = partsOf(cloud);
  const Span* all = parts.size() == 1 ? std::get_if<Span>(&parts[0]) : nullptr;
  if (all && all->size == cloud.point_step)
    return write(cloud.data.data(), cloud.data.size());
  for (std::size_t i = 0; i < numberOfPoints(cloud); ++i) {
    const std::uint8_t* point = &cloud.data[i * cloud.point_step];
    for (const auto& part : parts)
      if (const auto* span = std::get_if<Span>(&part))
        write(point + span->offset, span->size);
      else
        writeField(stream, std::get<pcl::PCLPointField>(part), point);
  }
}

/** Write the length of a face's list of points. */
void
writeLength(std::ostream& stream, std::size_t length, bool in_a_byte)
{
  if (in_a_byte)
    writeBytes(stream, static_cast<std::uint8_t>(length));
  else
    writeBytes(stream, static_cast<std::uint32_t>(length));
}

} // namespace

void
writePLY(std::ostream& stream, const Geometry& geometry)
{
  const auto& cloud = geometry.cloud;
  const bool short_faces =
      std::all_of(geometry.faces.begin(), geometry.faces.end(), [](const auto& face) {
        return face.vertices.size() <= std::numeric_limits<std::uint8_t>::max();
      });

  stream << "ply\nformat "
         << (cloud.is_bigendian ? "binary_big_endian" : "binary_little_endian")
         << " 1.0\n";
  if (cloud.height > 1) // PCL's convention for organised clouds
    stream << "obj_info num_cols " << cloud.width << "\nobj_info num_rows "
           << cloud.height << '\n';
  stream << "element vertex " << numberOfPoints(cloud) << '\n';
  for (const auto& field : cloud.fields)
    if (!isPadding(field))
      writeProperties(stream, field);
  if (!geometry.faces.empty())
    stream << "element face " << geometry.faces.size() << "\nproperty list "
           << (short_faces ? "uchar" : "uint") << " int vertex_indices\n";
  stream << "end_header\n";

  writePoints(stream, cloud);
  for (const auto& face : geometry.faces) {
    writeLength(stream, face.vertices.size(), short_faces);
    for (const auto vertex : face.vertices)
      writeBytes(stream, static_cast<std::int32_t>(vertex));
  }
}

} // namespace tool
