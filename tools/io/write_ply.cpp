/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "fields.h"
#include "format_writers.h"
#include "numbers.h"
#include "value_output.h"

#include <pcl/common/io.h>

#include <algorithm>
#include <cstring>
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

/** Write a field value by value. */
void
writeField(ValueOutput& output,
           const pcl::PCLPointField& field,
           const std::uint8_t* point)
{
  if (isPackedColour(field)) {
    const auto colour = getColour(field, point);
    for (std::size_t i = 0; i < (field.name == "rgba" ? 4 : 3); ++i)
      output.write(colour[i]);
    return;
  }
  const bool is_double = typeName(field.datatype) == "double";
  for (std::size_t i = 0; i < std::max<std::size_t>(field.count, 1); ++i)
    if (is_double)
      output.write(getNumber(field, point, i));
    else
      withType(field.datatype, [&](auto number) {
        std::memcpy(&number, point + field.offset + i * sizeof number, sizeof number);
        output.write(number);
      });
}

/** Write the points field by field. */
void
writeFields(ValueOutput& output, const pcl::PCLPointCloud2& cloud)
{
  for (std::size_t i = 0; i < numberOfPoints(cloud); ++i) {
    for (const auto& field : cloud.fields)
      if (!isPadding(field))
        writeField(output, field, &cloud.data[i * cloud.point_step]);
    output.endElement();
  }
}

/** Write the points, as many bytes at once as stand in the file as they do in memory.
 */
void
writePoints(std::ostream& stream, const pcl::PCLPointCloud2& cloud)
{
  ValueOutput output(stream, Storage::BINARY);
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
        writeField(output, std::get<pcl::PCLPointField>(part), point);
  }
}

/** The name of an encoding, as the header has it. */
const char*
encodingName(Storage storage)
{
  switch (storage) {
  case Storage::TEXT:
    return "ascii";
  case Storage::BINARY_BIG:
    return "binary_big_endian";
  default:
    return "binary_little_endian";
  }
}

/** Write what stands in the header for readers only. */
void
writeComments(std::ostream& stream, const std::vector<std::string>& comments)
{
  for (const auto& comment : comments) {
    const bool is_for_programs = comment.compare(0, 9, "obj_info ") == 0 &&
                                 comment.compare(9, 4, "num_") != 0; // a size
    stream << (is_for_programs ? "" : "comment ") << comment << '\n';
  }
}

void
writeFaces(ValueOutput& output, const std::vector<pcl::Vertices>& faces, bool are_short)
{
  for (const auto& face : faces) {
    if (are_short)
      output.write(static_cast<std::uint8_t>(face.vertices.size()));
    else
      output.write(static_cast<std::uint32_t>(face.vertices.size()));
    for (const auto vertex : face.vertices)
      output.write(static_cast<std::int32_t>(vertex));
    output.endElement();
  }
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

  stream << "ply\nformat " << encodingName(geometry.storage) << " 1.0\n";
  writeComments(stream, geometry.comments);
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

  ValueOutput output(stream, geometry.storage);
  if (geometry.storage == Storage::TEXT || geometry.storage == Storage::BINARY_BIG)
    writeFields(output, cloud);
  else
    writePoints(stream, cloud);
  writeFaces(output, geometry.faces, short_faces);
}

} // namespace tool
