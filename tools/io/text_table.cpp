/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "text_table.h"

#include "fields.h"
#include "vector_field.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>

namespace tool {
namespace {

/** Whether three columns have unit length in every row: nothing but normals has that.
 * Those that could not be found may be zeros, or no numbers.
 */
bool
holdNormals(const TextTable& table, std::size_t first)
{
  std::size_t found = 0, missing = 0;
  bool are_whole = true;
  for (std::size_t row = 0; row < table.values.size(); row += table.columns) {
    const double* normal = &table.values[row + first];
    const double length = std::hypot(normal[0], normal[1], normal[2]);
    if (std::isnan(length) || length == 0.0)
      ++missing;
    else if (std::abs(length - 1.0) > 0.01)
      return false;
    else
      ++found;
    for (std::size_t i = 0; i < 3; ++i)
      are_whole = are_whole && (normal[i] == std::round(normal[i]));
  }
  // whole numbers behind other columns may be a class of three
  return found > 0 && missing <= found && (first == 3 || !are_whole);
}

bool
holdBytes(const TextTable& table, const std::array<std::size_t, 3>& columns)
{
  for (std::size_t row = 0; row < table.values.size(); row += table.columns)
    for (const auto column : columns) {
      const double value = table.values[row + column];
      if (!(value >= 0.0 && value <= 255.0) || value != std::floor(value))
        return false;
    }
  return true;
}

/** Whether the first column is whole, and no row has less than a step more than the one
 * before it, or more than one. */
bool
firstColumnSteps(const TextTable& table, double least)
{
  const auto& values = table.values;
  if (values.size() < 2 * table.columns || values[0] != std::round(values[0]))
    return false;
  for (std::size_t row = table.columns; row < values.size(); row += table.columns) {
    const double step = values[row] - values[row - table.columns];
    const bool may_be_gap = table.rows_without_point > 0 && step == std::round(step);
    if (!(step >= least) || !(step == 0.0 || step == 1.0 || may_be_gap))
      return false;
  }
  return true;
}

/** Whether some value of a column has a fraction. */
bool
hasFractions(const TextTable& table, std::size_t column)
{
  for (std::size_t at = column; at < table.values.size(); at += table.columns)
    if (table.values[at] != std::round(table.values[at]))
      return true;
  return false;
}

/** Leave out a first row of 0, 1, 2, ... above fractions, which numbers the columns. */
void
dropNumbersOfColumns(TextTable& table)
{
  for (std::size_t i = 0; i < table.columns; ++i)
    if (table.values[i] != static_cast<double>(i))
      return;
  if (!hasFractions(table, 0) || !hasFractions(table, 1) || !hasFractions(table, 2))
    return;
  table.values.erase(table.values.begin(), table.values.begin() + table.columns);
  table.assumed.push_back("the first row (0 1 2 ...) was taken for the numbers of the "
                          "columns and is left out");
}

/** Points of maps and scans often have their number, or row, before x. */
void
tellOfNumbersOfRows(TextTable& table)
{
  if (table.columns > 3 && table.first_position == 0 && firstColumnSteps(table, 0.0) &&
      (hasFractions(table, 2) || hasFractions(table, 3)))
    table.assumed.push_back("column 1 looks like numbers of points or rows, but was "
                            "taken for x; name the columns");
}

/** Name the columns that the file does not name. */
void
nameColumns(TextTable& table, FileFormat format)
{
  for (std::size_t i = 0; i < table.columns; ++i)
    table.names.push_back("column_" + std::to_string(i + 1));
  std::copy_n(VectorField::POSITION.begin(), 3,
              table.names.begin() + table.first_position);
  for (std::size_t first = table.first_position + 3; first + 3 <= table.columns;
       ++first)
    if (holdNormals(table, first)) {
      std::copy_n(VectorField::NORMAL.begin(), 3, table.names.begin() + first);
      return;
    }
  if (format != FileFormat::PTS)
    return;
  const std::size_t columns = table.columns;
  if (columns == 4 || columns == 7)
    table.names[3] = "intensity";
  const std::size_t red = columns == 6 ? 3 : 4;
  if ((columns == 6 || columns == 7) && holdBytes(table, {red, red + 1, red + 2})) {
    const std::array<const char*, 3> colours{"red", "green", "blue"};
    std::copy(colours.begin(), colours.end(), table.names.begin() + red);
  }
}

std::size_t
find(const std::vector<std::string>& names, const std::string& name)
{
  return std::find(names.begin(), names.end(), name) - names.begin();
}

/** Where a column goes. */
struct Place {
  std::size_t column;
  pcl::PCLPointField field;
};

/** Whether a column is a part of the colour. */
bool
isColour(const std::string& name)
{
  return name == "red" || name == "green" || name == "blue";
}

} // namespace

bool
firstColumnCounts(const TextTable& table)
{
  return firstColumnSteps(table, 1.0);
}

Geometry
toGeometry(TextTable table, FileFormat format)
{
  Geometry geometry;
  geometry.from_text = true;
  if (table.has_names)
    geometry.header_mark = table.header_mark;
  else if (!table.values.empty()) {
    dropNumbersOfColumns(table);
    tellOfNumbersOfRows(table);
    nameColumns(table, format);
  }
  geometry.assumed = std::move(table.assumed);
  if (table.rows_without_point > 0)
    geometry.assumed.push_back(
        (table.rows_without_point == 1
             ? std::string("a row holds no point")
             : std::to_string(table.rows_without_point) + " rows hold no point") +
        " (line " + std::to_string(table.first_without_point) +
        (table.rows_without_point == 1 ? ") and is left out"
                                       : " first) and are left out"));
  if (table.values.empty())
    throw std::runtime_error("has no finite points");

  const std::array<std::size_t, 3> colour{
      find(table.names, "red"), find(table.names, "green"), find(table.names, "blue")};
  const bool has_colour =
      *std::max_element(colour.begin(), colour.end()) < table.columns &&
      holdBytes(table, colour);
  auto& cloud = geometry.cloud;
  checkNames(table.names);
  std::vector<Place> places;
  for (std::size_t i = 0; i < table.columns; ++i) {
    if (table.kinds[i] == TextTable::Kind::WORDS) {
      const auto stray = table.strays.find(i);
      geometry.left_out.push_back(
          "column '" + table.names[i].substr(0, 40) + "'" +
          (stray == table.strays.end() ? "" : " (" + stray->second + ')'));
      continue;
    }
    if (has_colour && isColour(table.names[i])) {
      if (!findField(cloud, "rgb"))
        addField(cloud, "rgb", pcl::PCLPointField::FLOAT32);
      continue;
    }
    addField(cloud, table.names[i], pcl::PCLPointField::FLOAT64);
    places.push_back({i, cloud.fields.back()});
  }
  const std::size_t rows = table.values.size() / table.columns;
  setNumberOfPoints(cloud, rows);
  const auto* rgb = has_colour ? findField(cloud, "rgb") : nullptr;
  for (std::size_t i = 0; i < rows; ++i) {
    const double* row = &table.values[i * table.columns];
    std::uint8_t* point = &cloud.data[i * cloud.point_step];
    for (const auto& place : places)
      std::memcpy(point + place.field.offset, row + place.column, sizeof(double));
    if (rgb)
      for (std::size_t k = 0; k < 3; ++k) // blue first, as PCL packs them
        point[rgb->offset + k] = static_cast<std::uint8_t>(row[colour[2 - k]]);
  }
  return geometry;
}

} // namespace tool
