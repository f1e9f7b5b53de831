/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "fields.h"
#include "file_bytes.h"
#include "format_readers.h"
#include "text_lines.h"

#include <boost/algorithm/string/join.hpp>
#include <boost/algorithm/string/predicate.hpp>
#include <boost/algorithm/string/trim.hpp>

#include <algorithm>
#include <array>
#include <cstring>
#include <map>
#include <stdexcept>

/** \file
 * Assimp 5.2 reads facets of text that are broken as something else, without a word.
 */

namespace tool {
namespace {

/** Triangles whose corners are joined where they have the same place. Their normals
 * belong to them and not to the corners, and follow from them. */
class Triangles {
public:
  void
  addCorner(const std::array<double, 3>& position)
  {
    if (corners_++ % 3 == 0)
      faces_.emplace_back();
    // as bytes, so that what is no number equals itself; and one zero, not two
    std::array<std::uint64_t, 3> key;
    for (std::size_t i = 0; i < 3; ++i) {
      const double value = position[i] + 0.0;
      std::memcpy(&key[i], &value, sizeof value);
    }
    const auto place = points_.emplace(key, points_.size());
    if (place.second)
      values_.insert(values_.end(), position.begin(), position.end());
    faces_.back().vertices.push_back(static_cast<pcl::index_t>(place.first->second));
  }

  Geometry
  geometry() const
  {
    Geometry geometry;
    geometry.cloud = cloudOfDoubles(values_, {"x", "y", "z"});
    geometry.faces = faces_;
    return geometry;
  }

private:
  std::size_t corners_ = 0;
  std::map<std::array<std::uint64_t, 3>, std::size_t> points_;
  std::vector<double> values_;
  std::vector<pcl::Vertices> faces_;
};

Geometry
readBinary(std::istream& stream, std::uint32_t triangles, std::uint64_t more_bytes)
{
  Triangles mesh;
  bool has_attributes = false;
  for (std::uint32_t i = 0; i < triangles; ++i) {
    std::array<float, 12> numbers; // the normal, and three corners
    std::array<char, 2> attribute;
    stream.read(reinterpret_cast<char*>(numbers.data()), sizeof numbers);
    stream.read(attribute.data(), sizeof attribute);
    if (!stream)
      throw std::runtime_error("cannot be read to its end");
    has_attributes = has_attributes || attribute[0] != 0 || attribute[1] != 0;
    for (std::size_t k = 3; k < 12; k += 3)
      mesh.addCorner({numbers[k], numbers[k + 1], numbers[k + 2]});
  }
  Geometry geometry = mesh.geometry();
  setCoordinateType(geometry, pcl::PCLPointField::FLOAT32);
  geometry.storage = Storage::BINARY;
  if (has_attributes)
    geometry.left_out.push_back("attributes (colours) of triangles");
  if (more_bytes > 0)
    geometry.left_out.push_back(std::to_string(more_bytes) +
                                " bytes behind the triangles");
  return geometry;
}

/** Whether a word of a file is that one, in upper or lower case. */
bool
isWord(std::string_view found, std::string_view word)
{
  return found.size() == word.size() &&
         std::equal(found.begin(), found.end(), word.begin(), [](char a, char b) {
           return a == b || (a >= 'A' && a <= 'Z' && a - 'A' + 'a' == b);
         });
}

/** Go to the next line within a solid. \return its words */
const std::vector<std::string_view>&
nextWords(TextLines& lines)
{
  if (!lines.next())
    throw std::runtime_error(
        "the file ends within a solid; it is damaged or incomplete");
  return lines.words();
}

/** Go to the next line, which must be those words and perhaps numbers. */
void
expect(TextLines& lines,
       std::initializer_list<const char*> words,
       std::size_t numbers = 0)
{
  const auto& found = nextWords(lines);
  if (found.size() != words.size() + numbers ||
      !std::equal(words.begin(), words.end(), found.begin(),
                  [](const char* word, auto other) { return isWord(other, word); })) {
    const std::vector<std::string> expected(words.begin(), words.end());
    lines.fail("'" + lines.text().substr(0, 40) + "' stands where '" +
               boost::algorithm::join(expected, " ") +
               (numbers > 0 ? " x y z' should be" : "' should be"));
  }
}

/** Read the lines of a text from the first one, which starts with solid. */
Geometry
readFacets(TextLines& lines)
{
  Triangles mesh;
  std::size_t solids = 0;
  std::string name;
  do {
    if (!isWord(lines.words()[0], "solid"))
      lines.failAt(lines.words()[0], "stands where 'solid' should be");
    name = lines.text().substr(std::strlen("solid"));
    ++solids;
    for (;;) {
      const auto& words = nextWords(lines);
      if (isWord(words[0], "endsolid"))
        break;
      // Normals are not needed, and programs write all sorts of things for slivers.
      if (words.size() != 5 || !isWord(words[0], "facet") ||
          !isWord(words[1], "normal"))
        lines.fail("'" + lines.text().substr(0, 40) +
                   "' stands where 'facet normal x y z' should be");
      expect(lines, {"outer", "loop"});
      for (int corner = 0; corner < 3; ++corner) {
        expect(lines, {"vertex"}, 3);
        const auto& numbers = lines.numbers(1);
        mesh.addCorner({numbers[0], numbers[1], numbers[2]});
      }
      expect(lines, {"endloop"});
      expect(lines, {"endfacet"});
    }
  } while (lines.next());
  Geometry geometry = mesh.geometry();
  geometry.from_text = true;
  geometry.storage = Storage::TEXT;
  if (solids > 1)
    geometry.left_out.push_back("the division into " + std::to_string(solids) +
                                " solids");
  else if (boost::algorithm::trim(name); !name.empty())
    geometry.comments = {name};
  return geometry;
}

/** The text in the header of a binary file, if any. */
std::vector<std::string>
commentsOf(std::string_view header)
{
  const std::string text =
      boost::algorithm::trim_copy(std::string(header.substr(0, header.find('\0'))));
  const bool is_text = std::all_of(text.begin(), text.end(),
                                   [](char c) { return c >= ' ' && c <= '~'; });
  return is_text && !text.empty() ? std::vector<std::string>{text}
                                  : std::vector<std::string>();
}

/** Whether a file starts as text does: binary files start with any word, but hold
 * zeros.
 */
bool
startsAsText(std::string_view start)
{
  start.remove_prefix(
      std::min(start.find_first_not_of("\xEF\xBB\xBF \t\r\n"), start.size()));
  return boost::algorithm::istarts_with(start, "solid") &&
         start.find('\0') == std::string_view::npos;
}

} // namespace

Geometry
readSTL(std::istream& stream)
{
  constexpr std::uint64_t header_size = 84, triangle_size = 50;
  const std::uint64_t size = remainingBytes(stream);
  std::array<char, 1024> start{};
  stream.read(start.data(), start.size());
  const auto read = static_cast<std::size_t>(stream.gcount());
  stream.clear();
  std::uint32_t triangles; // the last number of a binary header
  std::memcpy(&triangles, &start[header_size - sizeof triangles], sizeof triangles);
  const std::uint64_t needed = header_size + triangle_size * triangles;
  const bool is_text = startsAsText({start.data(), read});
  if (size == needed || (!is_text && triangles > 0 && size > needed)) {
    stream.seekg(header_size);
    Geometry geometry = readBinary(stream, triangles, size - needed);
    geometry.comments = commentsOf({start.data(), header_size - sizeof triangles});
    return geometry;
  }

  stream.seekg(0);
  TextLines lines(stream, TextLines::Style::RAW);
  if (!is_text || !lines.next())
    throw std::runtime_error("is neither a text that starts with solid, nor as long as "
                             "its number of triangles says; the file is damaged or "
                             "incomplete");
  return readFacets(lines);
}

} // namespace tool
