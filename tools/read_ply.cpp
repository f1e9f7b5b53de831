/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "format_readers.h"
#include "ply_header.h"
#include "text_lines.h"

#include <pcl/io/ply_io.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <stdexcept>

namespace tool {
namespace {

bool
isByte(const PLYHeader::Property* property)
{
  return property && (property->type == "uchar" || property->type == "uint8");
}

/** PCL packs colours of single bytes, and writes outside of the point where some are
 * missing.
 */
void
checkColours(const PLYHeader::Element& vertex)
{
  for (const std::string prefix : {"", "diffuse_"}) {
    const bool red = isByte(vertex.find(prefix + "red"));
    if (isByte(vertex.find(prefix + "green")) != red ||
        isByte(vertex.find(prefix + "blue")) != red ||
        (prefix.empty() && isByte(vertex.find("alpha")) && !red &&
         !isByte(vertex.find("diffuse_red"))))
      throw std::runtime_error(
          "its colours lack red, green or blue bytes; save it with "
          "all of them or with none");
  }
}

void
checkVertices(const PLYHeader& header)
{
  const auto* vertex = header.find("vertex");
  if (!vertex || vertex->count == 0)
    throw std::runtime_error("holds no points");
  if (vertex->count > std::numeric_limits<std::int32_t>::max())
    throw std::runtime_error("has more points than can be read");
  for (const auto& property : vertex->properties)
    if (!property.length_type.empty())
      throw std::runtime_error("its points have lists ('" + property.name +
                               "'), which cannot be read; save it without them");
  if (header.columns > 0 && header.rows > 0 &&
      (vertex->count - 1) / header.columns >= header.rows)
    throw std::runtime_error("has more points than num_cols times num_rows of its "
                             "header; save it without these two");
  checkColours(*vertex);
}

/** PCL reads the faces' points from lists of bytes' length only. */
void
checkFaces(const PLYHeader& header)
{
  const auto* face = header.find("face");
  if (!face || face->count == 0)
    return;
  const auto* indices = face->find("vertex_indices");
  if (!indices)
    indices = face->find("vertex_index");
  static const std::set<std::string> types{"int", "int32", "uint", "uint32"};
  if (!indices ||
      (indices->length_type != "uchar" && indices->length_type != "uint8") ||
      !types.count(indices->type))
    throw std::runtime_error("its faces cannot be read; save it with 'property list "
                             "uchar int vertex_indices'");
}

/** Checked before PCL sees the file: PCL 1.13 ends the program on some of these, and
 * takes others for something else.
 * \return the number of points of the cloud, with those missing from a range grid
 */
std::uint64_t
checkFile(const std::string& path)
{
  std::ifstream stream(path, std::ios::binary);
  const PLYHeader header(stream);
  checkVertices(header);
  checkFaces(header);

  const std::uint64_t remaining =
      std::filesystem::file_size(path) - static_cast<std::uint64_t>(stream.tellg());
  for (const auto& element : header.elements) {
    // In text, a number takes a digit and a separator.
    const std::uint64_t least =
        header.ascii ? 2 * element.properties.size() : element.leastBytes();
    if (least > 0 && element.count > (remaining + 1) / least)
      throw std::runtime_error("holds less data than its header announces; the file is "
                               "damaged or incomplete");
  }
  if (header.ascii)
    countRows(stream, header.lines, 0);

  const auto* grid = header.find("range_grid");
  return grid && grid->count > 0 ? grid->count : header.find("vertex")->count;
}

} // namespace

Geometry
readPLY(const std::string& path)
{
  const std::uint64_t points = checkFile(path);

  pcl::PolygonMesh mesh;
  if (pcl::PLYReader().read(path, mesh) < 0)
    throw std::runtime_error("the file is damaged or incomplete");

  Geometry geometry;
  geometry.cloud = std::move(mesh.cloud);
  geometry.faces = std::move(mesh.polygons);

  // Without a range grid, PCL believes num_cols and num_rows (or the image size of a
  // camera) rather than the number of points, and makes up the points that are missing.
  auto& cloud = geometry.cloud;
  if (static_cast<std::uint64_t>(cloud.width) * cloud.height != points) {
    cloud.width = static_cast<pcl::uindex_t>(points);
    cloud.height = 1;
    cloud.data.resize(std::min(cloud.data.size(), points * cloud.point_step));
  }
  return geometry;
}

} // namespace tool
