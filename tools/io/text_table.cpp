/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "text_table.h"

#include "fields.h"
#include "normal_check.h"
#include "vector_field.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>

namespace tool {
namespace {

/** Whether three columns are normals, by their length. */
bool
holdNormals(const TextTable& table, std::size_t first, FileFormat format)
{
  NormalCheck check;
  bool are_whole = true;
  for (std::size_t row = 0; row < table.values.size() && !check.hasOthers();
       row += table.columns) {
    const double* normal = &table.values[row + first];
    check.add(normal[0], normal[1], normal[2]);
    for (std::size_t i = 0; i < 3; ++i)
      are_whole = are_whole && (normal[i] == std::round(normal[i]));
  }
  // whole numbers behind other columns may be a class of three, but PTS has none
  const bool may_be_whole = first == table.first_position + 3 ||
                            (format == FileFormat::PTS && first + 3 == table.columns);
  return check.areNormals() && (may_be_whole || !are_whole);
}

bool
holdBytes(const TextTable& table, const std::vector<std::size_t>& columns)
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
  std::size_t first = table.first_position + 3, end = table.columns;
  while (first + 3 <= table.columns && !holdNormals(table, first, format))
    ++first;
  if (first + 3 <= table.columns) {
    std::copy_n(VectorField::NORMAL.begin(), 3, table.names.begin() + first);
    end = first;
  }
  // what PTS has between the position and the normal: intensity, colour, or both
  if (format != FileFormat::PTS || end < 4 || end > 7 || end == 5)
    return;
  if (end != 6)
    table.names[3] = "intensity";
  if (end >= 6 && holdBytes(table, {end - 3, end - 2, end - 1}))
    std::copy_n(std::array<const char*, 3>{"red", "green", "blue"}.begin(), 3,
                table.names.begin() + (end - 3));
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

/** The columns that become the colour, blue first, as PCL packs them; none where there
 * is no colour of bytes. */
std::vector<std::size_t>
columnsOfColour(const TextTable& table)
{
  std::vector<std::size_t> columns{
      find(table.names, "blue"), find(table.names, "green"), find(table.names, "red")};
  if (*std::max_element(columns.begin(), columns.end()) >= table.columns ||
      !holdBytes(table, columns))
    return {};
  const std::size_t alpha = find(table.names, "alpha");
  if (alpha < table.columns && holdBytes(table, {alpha}))
    columns.push_back(alpha);
  return columns;
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
    if (format != FileFormat::PTS) // which no program writes from a table
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

  const std::vector<std::size_t> colour = columnsOfColour(table);
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
    if (std::count(colour.begin(), colour.end(), i) > 0) {
      if (i != *std::min_element(colour.begin(), colour.end()))
        ;
      else if (colour.size() == 4)
        addField(cloud, "rgba", pcl::PCLPointField::UINT32);
      else
        addField(cloud, "rgb", pcl::PCLPointField::FLOAT32);
      continue;
    }
    addField(cloud, table.names[i], pcl::PCLPointField::FLOAT64);
    places.push_back({i, cloud.fields.back()});
  }
  const std::size_t rows = table.values.size() / table.columns;
  setNumberOfPoints(cloud, rows);
  const auto* packed = findField(cloud, colour.size() == 4 ? "rgba" : "rgb");
  for (std::size_t i = 0; i < rows; ++i) {
    const double* row = &table.values[i * table.columns];
    std::uint8_t* point = &cloud.data[i * cloud.point_step];
    for (const auto& place : places)
      std::memcpy(point + place.field.offset, row + place.column, sizeof(double));
    for (std::size_t k = 0; k < colour.size(); ++k)
      point[packed->offset + k] = static_cast<std::uint8_t>(row[colour[k]]);
  }
  return geometry;
}

} // namespace tool
