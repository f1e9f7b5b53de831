/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "format_writers.h"
#include "text_row.h"

#include <string_view>

namespace tool {
namespace {

/** Writes the lines of points. */
class PointLines {
public:
  explicit PointLines(const pcl::PCLPointCloud2& cloud)
  : cloud_(cloud)
  , position_(selectFields(cloud, VectorField::POSITION))
  , colour_(colourField(cloud))
  {
  }

  void
  write(std::ostream& stream, std::size_t index) const
  {
    const std::uint8_t* point = &cloud_.data[index * cloud_.point_step];
    Row row = rowOf("v", position_, point);
    if (colour_)
      for (std::size_t k = 0; k < 3; ++k)
        row.addNumber(getColour(*colour_, point)[k] / 255.0f);
    row.writeTo(stream);
  }

private:
  const pcl::PCLPointCloud2& cloud_;
  Fields position_;
  const pcl::PCLPointField* colour_;
};

/** Write the statements of the file that the mesh is from, with all that other formats
 * have no room for. */
void
writeStatements(std::ostream& stream, const Geometry& geometry)
{
  const auto& cloud = geometry.cloud;
  const Fields position = selectFields(cloud, VectorField::POSITION);
  const auto& statements = geometry.statements;
  const std::string_view text = statements.text;
  std::size_t point = 0, normal = 0;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = text.find('\n', begin);
    const std::string_view line = text.substr(begin, end - begin);
    if (line == "v" || line.substr(0, 2) == "v ") {
      Row row = rowOf("v", position, &cloud.data[point++ * cloud.point_step]);
      if (line.size() > 2) // its colour
        row.addWord(std::string(line.substr(2)));
      row.writeTo(stream);
    }
    else if (line == "vn") {
      Row row("vn");
      for (const double number : statements.normals[normal++])
        row.addNumber(number);
      row.writeTo(stream);
    }
    else
      stream << line << '\n';
    begin = end + 1;
  }
}

} // namespace

void
writeOBJ(std::ostream& stream, const Geometry& geometry)
{
  if (!geometry.statements.text.empty())
    return writeStatements(stream, geometry);
  const auto& cloud = geometry.cloud;
  const PointLines points(cloud);
  const Fields normal = normalFields(cloud);
  for (std::size_t i = 0; i < numberOfPoints(cloud); ++i) {
    points.write(stream, i);
    if (!normal.empty())
      rowOf("vn", normal, &cloud.data[i * cloud.point_step]).writeTo(stream);
  }
  for (const auto& face : geometry.faces) {
    const std::size_t corners = face.vertices.size();
    if (corners == 0)
      continue;
    const bool is_face = corners > 2; // OBJ has lines and points, too
    Row row(is_face ? "f" : corners == 2 ? "l" : "p");
    for (const auto vertex : face.vertices) {
      const std::string number = std::to_string(vertex + 1);
      row.addWord(normal.empty() || !is_face ? number : number + "//" + number);
    }
    row.writeTo(stream);
  }
}

} // namespace tool
