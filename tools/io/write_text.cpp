/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "format_writers.h"
#include "text_row.h"

#include <array>

namespace tool {
namespace {

bool
isNamed(const pcl::PCLPointField& field)
{
  return field.name.compare(0, 7, "column_") != 0;
}

/** The names that a field has above its columns. */
void
addTitles(Row& row, const pcl::PCLPointField& field)
{
  std::string name = field.name;
  std::replace_if(
      name.begin(), name.end(),
      [](char c) { return std::string(",;\" \t").find(c) != std::string::npos; }, '_');
  if (isPackedColour(field)) {
    for (const char* title : {"r", "g", "b"})
      row.addWord(title);
    if (field.name == "rgba")
      row.addWord("a");
  }
  else if (field.count > 1)
    for (pcl::uindex_t i = 0; i < field.count; ++i)
      row.addWord(name + '_' + std::to_string(i));
  else if (field.name.compare(0, 7, "normal_") == 0 && field.name.size() == 8)
    row.addWord("n" + name.substr(7));
  else
    row.addWord(name);
}

/** Whether the first row would be taken for the numbers of the columns. */
bool
startsWithNumbersOfColumns(const Geometry& geometry)
{
  const Points points = positionsOf(geometry);
  const auto first = std::find_if(points.begin(), points.end(),
                                  [](const auto& point) { return point.allFinite(); });
  return first != points.end() && *first == Eigen::Vector3d(0.0, 1.0, 2.0);
}

/** Whether readers do not know what is in the columns without names: positions come
 * first, and normals of unit length behind them. */
bool
needsNames(const Fields& fields, const Geometry& geometry)
{
  const auto is_named = [](const auto* field) { return isNamed(*field); };
  const bool has_normals =
      fields.size() >= 6 &&
      std::equal(
          VectorField::NORMAL.begin(), VectorField::NORMAL.end(), fields.begin() + 3,
          [](const char* name, const auto* field) { return field->name == name; });
  return std::any_of(fields.begin() + (has_normals ? 6 : 3), fields.end(), is_named) ||
         (has_normals && !areNormalsByLength(geometry)) ||
         startsWithNumbersOfColumns(geometry);
}

/** What marks the line of the names: as in the file that was read, else as a comment.
 */
std::string
markOf(const Geometry& geometry)
{
  const std::string mark = geometry.header_mark.value_or("#");
  return mark.empty() || mark == "//" ? mark : mark + ' ';
}

/** The fields that PTS has room for. */
Fields
fieldsOfPTS(const Geometry& geometry)
{
  const auto& cloud = geometry.cloud;
  Fields fields = selectFields(cloud, VectorField::POSITION);
  for (const char* name : {"intensity", "rgb", "rgba"})
    if (const auto* field = findField(cloud, name))
      fields.push_back(field);
  const Fields normal = normalFields(cloud);
  if (areNormalsByLength(geometry))
    fields.insert(fields.end(), normal.begin(), normal.end());
  return fields;
}

} // namespace

void
writeText(std::ostream& stream, const Geometry& geometry, FileFormat format)
{
  const auto& cloud = geometry.cloud;
  const char separator = format == FileFormat::CSV ? ',' : ' ';
  Fields fields = selectFields(cloud, VectorField::POSITION); // where readers want them
  for (const auto& field : cloud.fields)
    if (!isPadding(field) && std::count(fields.begin(), fields.end(), &field) == 0)
      fields.push_back(&field);
  if (format == FileFormat::PTS) {
    fields = fieldsOfPTS(geometry);
    stream << numberOfPoints(cloud) << '\n';
  }
  else if (format == FileFormat::CSV || geometry.header_mark ||
           needsNames(fields, geometry)) {
    Row titles("", separator);
    for (const auto* field : fields)
      addTitles(titles, *field);
    if (format != FileFormat::CSV)
      stream << markOf(geometry);
    titles.writeTo(stream);
  }
  for (std::size_t i = 0; i < numberOfPoints(cloud); ++i)
    rowOf("", fields, &cloud.data[i * cloud.point_step], separator,
          format != FileFormat::PTS)
        .writeTo(stream);
}

} // namespace tool
