/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "format_writers.h"
#include "text_row.h"

#include <array>

namespace tool {
namespace {

/** A packed colour, or red, green, blue and perhaps alpha. */
Fields
colourFields(const pcl::PCLPointCloud2& cloud)
{
  if (const auto* packed = colourField(cloud))
    return {packed};
  const std::array<const char*, 4> names{"red", "green", "blue", "alpha"};
  const Fields fields = selectFields(cloud, names);
  const bool has_all = fields.size() >= 3 && fields[2]->name == "blue";
  return has_all ? fields : Fields{};
}

} // namespace

void
writeOFF(std::ostream& stream, const Geometry& geometry)
{
  const auto& cloud = geometry.cloud;
  Fields fields = selectFields(cloud, VectorField::POSITION);
  const Fields normal = normalFields(cloud);
  const Fields colour = colourFields(cloud);
  const Fields texture =
      selectFields(cloud, std::array<const char*, 2>{"texture_u", "texture_v"});
  for (const Fields* more : {&normal, &colour, &texture})
    fields.insert(fields.end(), more->begin(), more->end());

  stream << (texture.empty() ? "" : "ST") << (colour.empty() ? "" : "C")
         << (normal.empty() ? "" : "N") << "OFF\n"
         << numberOfPoints(cloud) << ' ' << geometry.faces.size() << " 0\n";
  for (std::size_t i = 0; i < numberOfPoints(cloud); ++i)
    rowOf("", fields, &cloud.data[i * cloud.point_step]).writeTo(stream);
  for (const auto& face : geometry.faces) {
    Row row;
    row.addNumber(face.vertices.size());
    for (const auto vertex : face.vertices)
      row.addNumber(vertex);
    row.writeTo(stream);
  }
}

} // namespace tool
