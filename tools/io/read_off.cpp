/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "fields.h"
#include "format_readers.h"
#include "text_lines.h"

#include <cmath>
#include <regex>
#include <stdexcept>

/** \file
 * Assimp 5.2 also reads OFF, but in single precision, not without faces, and with zeros
 * for what is missing at the end of an incomplete file.
 */

namespace tool {
namespace {

/** The number as a count or an index. */
std::size_t
toCount(const TextLines& lines, double number)
{
  if (!(number >= 0.0 && number <= std::numeric_limits<std::int32_t>::max()) ||
      number != std::floor(number))
    lines.fail("has a number that cannot be a count or the number of a point");
  return static_cast<std::size_t>(number);
}

void
nextLine(TextLines& lines)
{
  if (!lines.next())
    throw std::runtime_error(
        "holds fewer points or faces than its header announces; the "
        "file is damaged or incomplete");
}

/** Name the columns of the points by the letters before OFF. */
std::vector<std::string>
nameColumns(const std::string& keyword, std::size_t columns)
{
  std::vector<std::string> names{"x", "y", "z"};
  if (keyword.find('N') != std::string::npos)
    names.insert(names.end(), {"normal_x", "normal_y", "normal_z"});
  if (keyword.find('C') != std::string::npos)
    names.insert(names.end(), {"red", "green", "blue", "alpha"});
  for (std::size_t i = names.size(); i < columns; ++i)
    names.push_back("column_" + std::to_string(i + 1));
  names.resize(columns);
  return names;
}

} // namespace

Geometry
readOFF(std::istream& stream)
{
  TextLines lines(stream);
  nextLine(lines);
  std::string keyword;
  if (!lines.startsWithNumber()) { // the keyword may be left out
    keyword = lines.takeWord();
    if (!std::regex_match(keyword, std::regex("(ST)?C?N?OFF")))
      lines.fail("is no start of an OFF file in text with points of x, y and z");
    if (lines.text().empty())
      nextLine(lines);
  }
  const std::vector<double> counts = lines.numbers();
  if (counts.size() < 2)
    lines.fail("should hold the numbers of points, faces and edges");

  std::vector<double> values;
  std::size_t columns = 0;
  for (std::size_t points = toCount(lines, counts[0]); points > 0; --points) {
    nextLine(lines);
    const auto& row = lines.numbers();
    if (columns == 0)
      columns = row.size();
    if (row.size() != columns || columns < 3)
      lines.fail("has " + std::to_string(row.size()) +
                 " numbers, which is not a point " + "like the others with x, y and z");
    values.insert(values.end(), row.begin(), row.end());
  }
  if (values.empty())
    throw std::runtime_error("holds no points");

  Geometry geometry;
  for (std::size_t faces = toCount(lines, counts[1]); faces > 0; --faces) {
    nextLine(lines);
    const auto& row = lines.numbers(); // a colour may follow the points
    const std::size_t size = toCount(lines, row[0]);
    if (row.size() <= size)
      lines.fail("ends before the face does; the file is damaged or incomplete");
    pcl::Vertices face;
    for (std::size_t i = 1; i <= size; ++i)
      face.vertices.push_back(toCount(lines, row[i]));
    geometry.faces.push_back(face);
  }
  geometry.cloud = cloudOfDoubles(values, nameColumns(keyword, columns));
  geometry.from_text = true;
  return geometry;
}

} // namespace tool
