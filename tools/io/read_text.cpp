/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "fields.h"
#include "format_readers.h"
#include "text_lines.h"

#include <cmath>
#include <optional>
#include <stdexcept>

namespace tool {
namespace {

/** Text does not name its columns. Three of them that have unit length in every row are
 * normals: nothing else does that.
 */
bool
holdsNormals(const std::vector<double>& values, std::size_t columns)
{
  if (columns < 6)
    return false;
  bool found = false;
  for (std::size_t row = 0; row < values.size(); row += columns) {
    const double length = std::hypot(values[row + 3], values[row + 4], values[row + 5]);
    if (std::abs(length - 1.0) > 0.01)
      return false;
    found = found || std::isfinite(length);
  }
  return found;
}

std::vector<std::string>
nameColumns(const std::vector<double>& values, std::size_t columns)
{
  std::vector<std::string> names{"x", "y", "z"};
  if (holdsNormals(values, columns))
    names.insert(names.end(), {"normal_x", "normal_y", "normal_z"});
  while (names.size() < columns)
    names.push_back("column_" + std::to_string(names.size() + 1));
  return names;
}

} // namespace

Geometry
readText(std::istream& stream)
{
  TextLines lines(stream);
  std::vector<double> values;
  std::size_t columns = 0;
  std::optional<double> announced; // number of points, which .pts files start with
  bool may_be_title = true;
  while (lines.next()) {
    if (may_be_title && !lines.startsWithNumber()) {
      may_be_title = false;
      continue;
    }
    const auto& row = lines.numbers();
    may_be_title = false;
    if (columns == 0 && row.size() == 1 && !announced) {
      announced = row[0];
      may_be_title = true;
      continue;
    }
    if (columns == 0)
      columns = row.size();
    if (columns < 3)
      lines.fail("has " + std::to_string(columns) + " columns; x, y and z are needed");
    if (row.size() != columns)
      lines.fail("has " + std::to_string(row.size()) + " columns instead of " +
                 std::to_string(columns) + "; the file is damaged or incomplete");
    values.insert(values.end(), row.begin(), row.end());
  }
  if (stream.bad())
    throw std::runtime_error("cannot be read");
  if (columns == 0)
    throw std::runtime_error("holds no points");
  if (announced && *announced * columns != values.size())
    throw std::runtime_error(
        "holds " + std::to_string(values.size() / columns) +
        " points, but its first line announces another number; the "
        "file is damaged or incomplete");

  Geometry geometry;
  geometry.cloud = cloudOfDoubles(values, nameColumns(values, columns));
  geometry.from_text = true;
  return geometry;
}

} // namespace tool
