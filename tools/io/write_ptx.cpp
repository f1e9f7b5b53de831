/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "format_writers.h"
#include "text_row.h"

namespace tool {
namespace {

/** A line with the coordinates of a point. */
Row
rowOf(const Eigen::Vector3d& point)
{
  Row row;
  for (const double coordinate : point)
    row.addNumber(coordinate);
  return row;
}

} // namespace

void
writePTX(std::ostream& stream, const Geometry& geometry)
{
  const auto& cloud = geometry.cloud;
  const auto* intensity = findField(cloud, "intensity");
  const auto* colour = colourField(cloud);
  // before all points, for 0 0 0 means that there is none; and small numbers are left
  const Eigen::Vector3d origin =
      boundingBox(geometry).min().array().floor().matrix() - Eigen::Vector3d::Ones();
  stream << "1\n" << numberOfPoints(cloud) << '\n';
  rowOf(origin).writeTo(stream);
  stream << "1 0 0\n0 1 0\n0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n";
  Row last = rowOf(origin);
  last.addNumber(1);
  last.writeTo(stream);
  const VectorField position(cloud, VectorField::POSITION);
  for (std::size_t i = 0; i < numberOfPoints(cloud); ++i) {
    const std::uint8_t* bytes = &cloud.data[i * cloud.point_step];
    const Eigen::Vector3d point = position.get(bytes) - origin;
    Row row = rowOf(point.allFinite() ? point : Eigen::Vector3d(0.0, 0.0, 0.0));
    if (intensity)
      row.addField(*intensity, bytes);
    else
      row.addWord("0.5"); // as programs write what is not known
    if (colour)
      for (std::size_t k = 0; k < 3; ++k)
        row.addNumber(static_cast<int>(getColour(*colour, bytes)[k]));
    row.writeTo(stream);
  }
}

} // namespace tool
