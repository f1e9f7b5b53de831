/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "fields.h"
#include "file_bytes.h"
#include "format_readers.h"
#include "text_lines.h"

#include <boost/algorithm/string/join.hpp>

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
readBinary(std::istream& stream, std::uint32_t triangles)
{
  Triangles mesh;
  for (std::uint32_t i = 0; i < triangles; ++i) {
    std::array<float, 12> numbers; // the normal, and three corners
    stream.read(reinterpret_cast<char*>(numbers.data()), sizeof numbers);
    stream.ignore(2);
    if (!stream)
      throw std::runtime_error("cannot be read to its end");
    for (std::size_t k = 3; k < 12; k += 3)
      mesh.addCorner({numbers[k], numbers[k + 1], numbers[k + 2]});
  }
  Geometry geometry = mesh.geometry();
  setCoordinateType(geometry, pcl::PCLPointField::FLOAT32);
  return geometry;
}

/** Go to the next line, which must be those words and perhaps numbers. */
void
expect(TextLines& lines, const std::vector<std::string>& words, std::size_t numbers = 0)
{
  if (!lines.next())
    throw std::runtime_error(
        "the file ends within a solid; it is damaged or incomplete");
  const auto& found = lines.words();
  if (found.size() != words.size() + numbers ||
      !std::equal(words.begin(), words.end(), found.begin()))
    lines.fail("'" + lines.text().substr(0, 40) + "' stands where '" +
               boost::algorithm::join(words, " ") +
               (numbers > 0 ? " x y z' should be" : "' should be"));
}

/** Read the lines of a text from the first one, which starts with solid. */
Geometry
readFacets(TextLines& lines)
{
  Triangles mesh;
  do {
    if (lines.words()[0] != "solid")
      lines.failAt(lines.words()[0], "stands where 'solid' should be");
    for (;;) {
      if (!lines.next())
        throw std::runtime_error(
            "the file ends within a solid; it is damaged or incomplete");
      if (lines.words()[0] == "endsolid")
        break;
      // Normals are not needed, and programs write all sorts of things for slivers.
      if (lines.words().size() != 5 || lines.words()[0] != "facet" ||
          lines.words()[1] != "normal")
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
  return geometry;
}

} // namespace

Geometry
readSTL(std::istream& stream)
{
  constexpr std::uint64_t header_size = 84, triangle_size = 50;
  const std::uint64_t size = remainingBytes(stream);
  char header[header_size] = {};
  stream.read(header, header_size);
  std::uint32_t triangles; // the last number of a binary header
  std::memcpy(&triangles, header + header_size - sizeof triangles, sizeof triangles);
  if (size == header_size + triangle_size * triangles)
    return readBinary(stream, triangles);

  stream.clear();
  stream.seekg(0);
  TextLines lines(stream, TextLines::Style::STRICT);
  if (std::string(header, 5) != "solid" || !lines.next())
    throw std::runtime_error("is neither a text that starts with solid, nor as long as "
                             "its number of triangles says; the file is damaged or "
                             "incomplete");
  return readFacets(lines);
}

} // namespace tool
