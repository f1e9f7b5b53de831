/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "fields.h"
#include "file_bytes.h"
#include "format_readers.h"
#include "numbers.h"
#include "ply_header.h"
#include "ply_values.h"
#include "vector_field.h"

#include <pcl/common/io.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <stdexcept>

/** \file
 * PCL 1.13 ends the program on some PLY files, and takes others for something else. The
 * fields are named and packed as it does it.
 */

namespace tool {
namespace {

using Property = PLYHeader::Property;
using Element = PLYHeader::Element;

/** The place in a packed colour of the property of one byte that is a part of it; -1
 * for all others. */
int
placeInColour(const Property& property)
{
  if (property.datatype != pcl::PCLPointField::UINT8 || property.is_list)
    return -1;
  const std::string name = property.name.compare(0, 8, "diffuse_") == 0
                               ? property.name.substr(8)
                               : property.name;
  const std::array<const char*, 4> parts{"blue", "green", "red", "alpha"};
  for (std::size_t i = 0; i < parts.size(); ++i)
    if (name == parts[i])
      return static_cast<int>(i);
  return -1;
}

/** Where the value of a property goes. */
struct Column {
  std::uint8_t datatype;
  std::uint32_t offset;
  /** A byte that is stored as a float. */
  bool widen;
  /** A list, which goes nowhere; null for all others. */
  const Property* list = nullptr;
};

/** The parts that the colour of the points consists of, as bits; none where red, green
 * or blue is missing. */
int
partsOfColour(const Element& vertex)
{
  int parts = 0;
  for (const auto& property : vertex.properties)
    if (const int place = placeInColour(property); place >= 0)
      parts |= 1 << place;
  return (parts & 7) == 7 ? parts : 0;
}

/** Make the fields of the points, and columns for their properties. */
std::vector<Column>
makeFields(const Element& vertex, pcl::PCLPointCloud2& cloud)
{
  const int parts = partsOfColour(vertex);
  int taken = 0;
  std::vector<Column> columns;
  std::uint32_t colour = 0;
  bool has_colour = false;
  for (const auto& property : vertex.properties) {
    if (property.is_list) {
      columns.push_back({property.datatype, 0, false, &property});
      continue;
    }
    const int place = placeInColour(property);
    if (place >= 0 && (parts & ~taken & 1 << place)) { // not of a second colour
      taken |= 1 << place;
      if (!has_colour) {
        colour = cloud.point_step;
        if (parts & 8)
          addField(cloud, "rgba", pcl::PCLPointField::UINT32);
        else
          addField(cloud, "rgb", pcl::PCLPointField::FLOAT32);
        has_colour = true;
      }
      columns.push_back(
          {property.datatype, colour + static_cast<std::uint32_t>(place), false});
      continue;
    }
    const bool widen =
        property.name == "intensity" && property.datatype == pcl::PCLPointField::UINT8;
    columns.push_back({property.datatype, cloud.point_step, widen});
    const bool is_normal =
        property.name == "nx" || property.name == "ny" || property.name == "nz";
    addField(cloud, is_normal ? "normal_" + property.name.substr(1) : property.name,
             widen ? std::uint8_t(pcl::PCLPointField::FLOAT32) : property.datatype);
  }
  return columns;
}

/** Whether the values of a point stand in the file as they will in memory. */
bool
areAsInFile(const std::vector<Column>& columns)
{
  std::uint32_t end = 0;
  for (const auto& column : columns) {
    if (column.widen || column.list || column.offset != end)
      return false;
    end += pcl::getFieldSize(column.datatype);
  }
  return true;
}

void
skip(const Property& property, PLYValues& values)
{
  std::uint8_t unused[8];
  const std::uint64_t length =
      property.is_list ? values.takeCount(property.length_datatype) : 1;
  for (std::uint64_t i = 0; i < length; ++i)
    values.take(property.datatype, unused);
}

void
readPoints(const Element& vertex, PLYValues& values, pcl::PCLPointCloud2& cloud)
{
  const std::vector<Column> columns = makeFields(vertex, cloud);
  setNumberOfPoints(cloud, vertex.count);
  if (areAsInFile(columns) && values.takeElements(cloud.data.data(), cloud.data.size()))
    return;
  for (std::uint64_t i = 0; i < vertex.count; ++i) {
    std::uint8_t* point = &cloud.data[i * cloud.point_step];
    values.beginElement();
    for (const auto& column : columns) {
      if (column.list) {
        skip(*column.list, values);
        continue;
      }
      values.take(column.datatype, point + column.offset);
      if (column.widen) {
        const float wide = point[column.offset];
        std::memcpy(point + column.offset, &wide, sizeof wide);
      }
    }
    values.endElement();
  }
}

/** The property of faces that has the numbers of their points, or null. */
const Property*
indicesOf(const Element& element)
{
  const Property* indices = element.find("vertex_indices");
  return indices ? indices : element.find("vertex_index");
}

/** Read the numbers of points that faces and cells of grids have. */
std::vector<pcl::Vertices>
readLists(const Element& element, PLYValues& values)
{
  const Property* indices = indicesOf(element);
  if (!indices || !indices->is_list)
    throw std::runtime_error("its " + element.name +
                             "s cannot be read; save it with 'property list uchar int "
                             "vertex_indices'");
  constexpr std::uint32_t usual_length = 8; // more may be a lie
  std::vector<pcl::Vertices> lists;
  lists.reserve(element.count); // which the file has bytes for
  for (std::uint64_t i = 0; i < element.count; ++i) {
    lists.emplace_back();
    auto& vertices = lists.back().vertices;
    values.beginElement();
    for (const auto& property : element.properties)
      if (&property != indices)
        skip(property, values);
      else {
        auto length = values.takeCount(property.length_datatype);
        vertices.reserve(std::min(length, usual_length));
        for (; length > 0; --length)
          vertices.push_back(
              static_cast<pcl::index_t>(values.takeCount(property.datatype)));
      }
    values.endElement();
  }
  return lists;
}

/** Name what the file holds besides points, faces and grids of points. */
std::vector<std::string>
leftOut(const PLYHeader& header)
{
  std::vector<std::string> names;
  for (const auto& element : header.elements) {
    if (element.count == 0 || element.name == "range_grid")
      continue;
    if (element.name != "vertex" && element.name != "face") {
      names.push_back("element '" + element.name.substr(0, 40) + "'");
      continue;
    }
    for (const auto& property : element.properties) {
      const bool is_read = element.name == "vertex" ? !property.is_list
                                                    : &property == indicesOf(element);
      if (!is_read)
        names.push_back("property '" + property.name.substr(0, 40) + "' of " +
                        (element.name == "vertex" ? "points" : "faces"));
    }
  }
  return names;
}

/** Name elements that are not read and hold faces, as strips of triangles do. */
std::vector<std::string>
unreadFaces(const PLYHeader& header)
{
  std::vector<std::string> names;
  for (const auto& element : header.elements)
    if (element.count > 0 && element.name != "vertex" && element.name != "face" &&
        element.name != "range_grid" && indicesOf(element))
      names.push_back("its faces in the element '" + element.name.substr(0, 40) +
                      "' are not read; save them as elements 'face'");
  return names;
}

/** Place the points in the cells of a grid; cells without one get a point without a
 * place. */
void
arrange(const std::vector<pcl::Vertices>& cells, pcl::PCLPointCloud2& cloud)
{
  pcl::PCLPointCloud2 grid = cloud;
  setNumberOfPoints(grid, cells.size());
  for (std::size_t i = 0; i < cells.size(); ++i) {
    std::uint8_t* point = &grid.data[i * grid.point_step];
    if (cells[i].vertices.empty()) {
      for (const auto& field : grid.fields)
        if (isFloatingPoint(field))
          setNumber(field, point, std::numeric_limits<double>::quiet_NaN());
      continue;
    }
    const auto index = static_cast<std::size_t>(cells[i].vertices[0]);
    if (index >= numberOfPoints(cloud))
      throw std::runtime_error("its range_grid refers to point " +
                               std::to_string(index) + ", but there are only " +
                               std::to_string(numberOfPoints(cloud)));
    std::memcpy(point, &cloud.data[index * cloud.point_step], cloud.point_step);
  }
  cloud = std::move(grid);
}

/** What the header says must fit into the file before anything is made of its size. */
void
check(const PLYHeader& header, std::uint64_t bytes)
{
  constexpr std::uint64_t most = std::numeric_limits<std::int32_t>::max();
  const auto* vertex = header.find("vertex");
  if (!vertex || vertex->count == 0)
    throw std::runtime_error("holds no points");
  if (vertex->properties.empty())
    throw std::runtime_error("has no coordinate x");
  for (const auto& element : header.elements) {
    const std::uint64_t least = element.leastBytes(header.encoding);
    if (least > 0 && element.count > (bytes + 1) / least)
      throw std::runtime_error("holds less data than its header announces; the file is "
                               "damaged or incomplete");
    if (element.count > most)
      throw std::runtime_error("has more points or faces than can be read");
  }
  // A cell without a point takes little room in a file.
  constexpr std::uint64_t growth = 64;
  const auto* grid = header.find("range_grid");
  if (grid && grid->count * vertex->properties.size() > growth * bytes)
    throw std::runtime_error("its range_grid has too many cells for the file's size");
  if (header.columns > most || header.rows > most ||
      header.columns * header.rows > most)
    throw std::runtime_error(
        "num_cols times num_rows of its header is more than can be "
        "read; save it without these two");
  if (!grid && header.columns > 0 && header.rows > 0 &&
      (vertex->count - 1) / header.columns >= header.rows)
    throw std::runtime_error("has more points than num_cols times num_rows of its "
                             "header; save it without these two");
}

} // namespace

Geometry
readPLY(std::istream& stream)
{
  TextLines lines(stream, TextLines::Style::STRICT);
  const PLYHeader header(lines);
  // A last line without its end may be cut short.
  if (stream.eof())
    throw std::runtime_error("the file ends within its header");
  check(header, remainingBytes(stream));

  Geometry geometry;
  auto& cloud = geometry.cloud;
  std::vector<pcl::Vertices> cells;
  const auto values = plyValues(header.encoding, lines, stream);
  for (const auto& element : header.elements) {
    if (element.count == 0 || element.properties.empty())
      continue;
    if (element.name == "vertex")
      readPoints(element, *values, cloud);
    else if (element.name == "face")
      geometry.faces = readLists(element, *values);
    else if (element.name == "range_grid")
      cells = readLists(element, *values);
    else
      for (std::uint64_t i = 0; i < element.count; ++i) {
        values->beginElement();
        for (const auto& property : element.properties)
          skip(property, *values);
        values->endElement();
      }
  }
  values->end();
  geometry.comments = header.comments;
  geometry.left_out = leftOut(header);
  geometry.assumed = unreadFaces(header);
  geometry.storage = header.encoding == PLYHeader::Encoding::ASCII ? Storage::TEXT
                     : header.encoding == PLYHeader::Encoding::BIG ? Storage::BINARY_BIG
                                                                   : Storage::BINARY;

  if (!cells.empty())
    arrange(cells, cloud);
  // so both are numbers of points that are there, and small
  if (header.columns > 0 && header.rows > 0 &&
      numberOfPoints(cloud) % header.columns == 0 &&
      numberOfPoints(cloud) / header.columns == header.rows) {
    cloud.width = static_cast<pcl::uindex_t>(header.columns);
    cloud.height = static_cast<pcl::uindex_t>(header.rows);
    cloud.row_step = cloud.point_step * cloud.width;
  }
  return geometry;
}

} // namespace tool
