/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "format_readers.h"
#include "normal_check.h"
#include "text_lines.h"
#include "text_table.h"

#include <boost/algorithm/string/case_conv.hpp>
#include <boost/algorithm/string/predicate.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>

/** \file
 * Assimp 5.2 also reads OFF, but in single precision, not without faces, and with zeros
 * for what is missing at the end of an incomplete file.
 */

namespace tool {
namespace {

[[noreturn]] void
failAt(std::size_t line, const std::string& problem)
{
  throw std::runtime_error("line " + std::to_string(line) + ": " + problem);
}

/** All numbers behind the keyword, and where the lines start among them. */
struct Numbers {
  std::vector<double> values;
  std::vector<std::size_t> line_starts, line_numbers;

  void
  addLine(TextLines& lines)
  {
    line_starts.push_back(values.size());
    line_numbers.push_back(lines.number());
    const auto& numbers = lines.numbers();
    values.insert(values.end(), numbers.begin(), numbers.end());
  }

  std::size_t
  lineSize(std::size_t line) const
  {
    return (line + 1 < line_starts.size() ? line_starts[line + 1] : values.size()) -
           line_starts[line];
  }

  /** The number of the line in the file that holds a value. */
  std::size_t
  lineOf(std::size_t value) const
  {
    const auto next = std::upper_bound(line_starts.begin(), line_starts.end(), value);
    return line_numbers[next - line_starts.begin() - 1];
  }
};

/** A value as a count or an index. */
std::size_t
toCount(const Numbers& numbers, std::size_t at)
{
  const double number = numbers.values[at];
  if (!(number >= 0.0 && number <= std::numeric_limits<std::int32_t>::max()) ||
      number != std::floor(number))
    failAt(numbers.lineOf(at),
           "has a number that cannot be a count or the number of a point");
  return static_cast<std::size_t>(number);
}

[[noreturn]] void
failIncomplete()
{
  throw std::runtime_error("holds fewer points or faces than its header announces; the "
                           "file is damaged or incomplete");
}

/** Whether three columns from one on are normals, by their length. */
bool
areNormals(const std::vector<double>& points, std::size_t columns, std::size_t first)
{
  NormalCheck check;
  for (std::size_t at = first; at + 2 < points.size(); at += columns)
    check.add(points[at], points[at + 1], points[at + 2]);
  return check.areNormals();
}

/** What the keyword says of the points. */
struct Kind {
  bool has_normals, has_colours, has_texture;

  explicit Kind(const std::string& keyword)
  : has_normals(keyword.find('N') != std::string::npos)
  , has_colours(keyword.find('C') != std::string::npos)
  , has_texture(keyword.find("ST") != std::string::npos)
  {
  }

  /** Numbers of a point, with three or four for its colour. */
  std::size_t
  columns(std::size_t colour) const
  {
    return 3 + (has_normals ? 3 : 0) + (has_colours ? colour : 0) +
           (has_texture ? 2 : 0);
  }

  /** Name the columns of points. Programs do not agree whether normals come before
   * colours, but their lengths tell. */
  std::vector<std::string>
  names(const std::vector<double>& points, std::size_t columns) const
  {
    std::vector<std::string> names{"x", "y", "z"};
    const auto add_normals = [&] {
      names.insert(names.end(), {"normal_x", "normal_y", "normal_z"});
    };
    const std::size_t colour = columns >= this->columns(4) ? 4 : 3;
    const bool colours_first = has_normals && has_colours &&
                               !areNormals(points, columns, 3) &&
                               areNormals(points, columns, 3 + colour);
    if (has_normals && !colours_first)
      add_normals();
    if (has_colours) {
      names.insert(names.end(), {"red", "green", "blue"});
      if (colour == 4)
        names.push_back("alpha");
    }
    if (colours_first)
      add_normals();
    if (has_texture)
      names.insert(names.end(), {"texture_u", "texture_v"});
    for (std::size_t i = names.size(); i < columns; ++i)
      names.push_back("column_" + std::to_string(i + 1));
    names.resize(columns);
    return names;
  }
};

/** Where what is read of the file's numbers lies among them. */
struct Layout {
  std::size_t begin, points, columns, faces;
};

/** Numbers for each point, if each stands in a line of its own; 0 where not. */
std::size_t
columnsOfLines(const Numbers& numbers, const Layout& layout, std::size_t first_line)
{
  const std::size_t lines = numbers.line_starts.size();
  if (first_line >= lines || numbers.line_starts[first_line] != layout.begin ||
      lines - first_line < layout.points)
    return 0;
  const std::size_t columns = numbers.lineSize(first_line);
  for (std::size_t i = 0; i < layout.points; ++i)
    if (numbers.lineSize(first_line + i) != columns)
      return 0;
  return columns;
}

/** Why the lines cannot be the points. */
[[noreturn]] void
failAsLines(const Numbers& numbers, const Layout& layout, std::size_t first_line)
{
  const std::size_t lines = numbers.line_starts.size();
  for (std::size_t line = first_line;
       line < std::min(lines, first_line + layout.points); ++line)
    if (const std::size_t size = numbers.lineSize(line);
        size < 3 || size != numbers.lineSize(first_line))
      failAt(numbers.line_numbers[line],
             "has " + std::to_string(size) +
                 " numbers, which is not a point like the others with x, y and z");
  failIncomplete();
}

/** Read the faces from a value on.
 * \param[in] ends_with_line whether a face ends where its line does, so that a colour
 * may stand behind its points
 */
void
readFaces(const Numbers& numbers,
          const Layout& layout,
          bool ends_with_line,
          Geometry& geometry)
{
  std::size_t at = layout.begin + layout.points * layout.columns;
  std::size_t line =
      std::lower_bound(numbers.line_starts.begin(), numbers.line_starts.end(), at) -
      numbers.line_starts.begin();
  bool has_colours = false;
  for (std::size_t face = 0; face < layout.faces; ++face, ++line) {
    if (ends_with_line) {
      if (line >= numbers.line_starts.size())
        failIncomplete();
      at = numbers.line_starts[line];
    }
    const std::size_t end =
        ends_with_line ? at + numbers.lineSize(line) : numbers.values.size();
    if (at >= end)
      failIncomplete();
    const std::size_t size = toCount(numbers, at++);
    if (size > end - at)
      failAt(numbers.lineOf(at - 1),
             "ends before the face does; the file is damaged or incomplete");
    geometry.faces.emplace_back();
    for (std::size_t i = 0; i < size; ++i)
      geometry.faces.back().vertices.push_back(
          static_cast<pcl::index_t>(toCount(numbers, at++)));
    has_colours = has_colours || (ends_with_line && at < end);
  }
  if (!ends_with_line && at < numbers.values.size())
    failAt(numbers.lineOf(at), "is more than the header announces");
  if (has_colours)
    geometry.left_out.push_back("colours of faces");
}

/** Whether the faces stand in lines of their own, as many as there are. */
bool
areLines(const Numbers& numbers, const Layout& layout)
{
  const std::size_t at = layout.begin + layout.points * layout.columns;
  const auto first =
      std::lower_bound(numbers.line_starts.begin(), numbers.line_starts.end(), at);
  std::size_t line = first - numbers.line_starts.begin();
  if (layout.faces == 0)
    return true;
  if (first == numbers.line_starts.end() || *first != at ||
      numbers.line_starts.size() - line < layout.faces)
    return false;
  for (std::size_t face = 0; face < layout.faces; ++face, ++line)
    if (!(numbers.values[numbers.line_starts[line]] + 1.0 <=
          static_cast<double>(numbers.lineSize(line))))
      return false;
  return true;
}

/** Read the keyword, which may be left out, and which its counts may be glued to. */
std::string
takeKeyword(TextLines& lines)
{
  if (lines.startsWithNumber())
    return "";
  static const std::set<std::string_view> kinds{"",   "C",   "N",   "CN",   "NC",
                                                "ST", "STC", "STN", "STCN", "STNC"};
  const std::string word = boost::algorithm::to_upper_copy(lines.takeWord());
  const std::size_t off = word.find("OFF"), end = off + 3;
  if (off == std::string::npos ||
      kinds.count(std::string_view(word).substr(0, off)) == 0 ||
      word.find_first_not_of("0123456789", end) != std::string::npos ||
      boost::algorithm::istarts_with(lines.text(), "BINARY"))
    lines.fail("is no start of an OFF file in text with points of x, y and z");
  lines.putBack(word.substr(end));
  return word.substr(0, end);
}

} // namespace

Geometry
readOFF(std::istream& stream)
{
  TextLines lines(stream, TextLines::Style::COMMENTED);
  if (!lines.next())
    failIncomplete();
  const Kind kind(takeKeyword(lines));
  Numbers numbers;
  if (!lines.text().empty())
    numbers.addLine(lines);
  while (lines.next())
    numbers.addLine(lines);

  // the number of edges, which nobody needs, may be left out at the end of a line
  if (numbers.values.size() < 2)
    failIncomplete();
  Layout layout{};
  const bool has_no_edges = numbers.lineSize(0) == 2;
  layout.begin = has_no_edges ? 2 : 3;
  layout.points = toCount(numbers, 0);
  layout.faces = toCount(numbers, 1);
  if (layout.points == 0)
    throw std::runtime_error("holds no points");
  if (layout.begin >= numbers.values.size() || layout.points > numbers.values.size())
    failIncomplete();
  const std::size_t first_line =
      std::lower_bound(numbers.line_starts.begin(), numbers.line_starts.end(),
                       layout.begin) -
      numbers.line_starts.begin();

  const auto named = [&](Geometry geometry) {
    const auto first = numbers.values.begin() + layout.begin;
    const std::vector<double> points(first, first + layout.points * layout.columns);
    TextTable table;
    table.columns = layout.columns;
    table.names = kind.names(points, layout.columns);
    table.has_names = true;
    table.kinds.assign(layout.columns, TextTable::Kind::NUMBERS);
    table.values = points;
    geometry.cloud = toGeometry(std::move(table), FileFormat::OFF).cloud;
    geometry.from_text = true;
    return geometry;
  };

  // in lines of their own points may have more numbers than the keyword says
  const std::size_t columns = columnsOfLines(numbers, layout, first_line);
  layout.columns = columns;
  if (columns >= 3 && areLines(numbers, layout)) {
    Geometry geometry;
    readFaces(numbers, layout, true, geometry);
    return named(std::move(geometry));
  }
  for (const std::size_t colour : {4, 3}) {
    layout.columns = kind.columns(colour);
    if (layout.points > (numbers.values.size() - layout.begin) / layout.columns)
      continue;
    try {
      Geometry geometry;
      readFaces(numbers, layout, areLines(numbers, layout), geometry);
      return named(std::move(geometry));
    }
    catch (const std::runtime_error&) { // another number of columns, or none
    }
  }
  layout.columns = columns;
  Geometry ignored;
  if (columns >= 3) // what is wrong is in the faces
    readFaces(numbers, layout, true, ignored);
  failAsLines(numbers, layout, first_line);
}

} // namespace tool
