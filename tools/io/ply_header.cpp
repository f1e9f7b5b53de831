/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "ply_header.h"

#include "fields.h"
#include "numbers.h"

#include <map>
#include <stdexcept>

namespace tool {
namespace {

using Words = std::vector<std::string_view>;

std::uint8_t
datatypeOf(const TextLines& lines, std::string_view type)
{
  using Field = pcl::PCLPointField;
  static const std::map<std::string_view, std::uint8_t> types{
      {"char", Field::INT8},      {"int8", Field::INT8},
      {"uchar", Field::UINT8},    {"uint8", Field::UINT8},
      {"short", Field::INT16},    {"int16", Field::INT16},
      {"ushort", Field::UINT16},  {"uint16", Field::UINT16},
      {"int", Field::INT32},      {"int32", Field::INT32},
      {"uint", Field::UINT32},    {"uint32", Field::UINT32},
      {"float", Field::FLOAT32},  {"float32", Field::FLOAT32},
      {"double", Field::FLOAT64}, {"float64", Field::FLOAT64}};
  const auto found = types.find(type);
  if (found == types.end())
    lines.failAt(type, "is no type of PLY");
  return found->second;
}

std::size_t
bytesOf(std::uint8_t datatype)
{
  return withType(datatype, [](auto number) { return sizeof number; });
}

void
expectWords(const TextLines& lines, const Words& words, std::size_t number)
{
  if (words.size() != number)
    lines.fail("'" + std::string(words[0]) + "' has " +
               std::to_string(words.size() - 1) + " words after it instead of " +
               std::to_string(number - 1));
}

PLYHeader::Encoding
encodingOf(const TextLines& lines, const Words& words)
{
  expectWords(lines, words, 3);
  if (words[2] != "1.0")
    lines.failAt(words[2], "is no known version of PLY");
  if (words[1] == "ascii")
    return PLYHeader::Encoding::ASCII;
  if (words[1] == "binary_little_endian")
    return PLYHeader::Encoding::LITTLE;
  if (words[1] == "binary_big_endian")
    return PLYHeader::Encoding::BIG;
  lines.failAt(words[1], "is no known format of PLY");
}

std::uint64_t
countOf(const TextLines& lines, std::string_view word)
{
  std::int64_t count;
  if (!parseNumber(word, count) || count < 0)
    lines.failAt(word, "is not a number of something");
  return static_cast<std::uint64_t>(count);
}

PLYHeader::Property
propertyOf(const TextLines& lines, const Words& words)
{
  PLYHeader::Property property;
  property.is_list = words.size() > 1 && words[1] == "list";
  expectWords(lines, words, property.is_list ? 5 : 3);
  property.name = words.back();
  property.datatype = datatypeOf(lines, words[words.size() - 2]);
  if (property.is_list) {
    property.length_datatype = datatypeOf(lines, words[2]);
    if (words[2] == "float" || words[2] == "float32" || words[2] == "double" ||
        words[2] == "float64")
      lines.failAt(words[2], "cannot be the length of a list");
  }
  return property;
}

} // namespace

const PLYHeader::Property*
PLYHeader::Element::find(const std::string& property) const
{
  for (const auto& candidate : properties)
    if (candidate.name == property)
      return &candidate;
  return nullptr;
}

std::uint64_t
PLYHeader::Element::leastBytes(Encoding encoding) const
{
  std::uint64_t sum = 0;
  for (const auto& property : properties)
    if (encoding == Encoding::ASCII)
      sum += 2; // a digit and a separator
    else
      sum += bytesOf(property.is_list ? property.length_datatype : property.datatype);
  return sum;
}

PLYHeader::PLYHeader(TextLines& lines)
{
  if (!lines.next() || lines.text() != "ply")
    throw std::runtime_error("is no PLY file");
  bool has_format = false;
  while (lines.next()) {
    const auto& words = lines.words();
    if (words[0] == "end_header") {
      expectWords(lines, words, 1);
      if (!has_format)
        throw std::runtime_error("has no format in its header");
      for (const auto& element : elements) {
        std::vector<std::string> names;
        for (const auto& property : element.properties)
          names.push_back(property.name);
        checkNames(names);
      }
      return;
    }
    if (words[0] == "format") {
      if (has_format)
        lines.fail("the header has two formats");
      encoding = encodingOf(lines, words);
      has_format = true;
    }
    else if (words[0] == "element") {
      expectWords(lines, words, 3);
      const std::string name(words[1]);
      if (find(name))
        lines.failAt(name, "is in the header twice");
      constexpr std::size_t most = 1000; // more would be another file's data
      if (elements.size() == most)
        lines.fail("is one element more than can be read");
      elements.push_back({name, countOf(lines, words[2]), {}});
    }
    else if (words[0] == "property") {
      if (elements.empty())
        lines.fail("a property comes before all elements");
      elements.back().properties.push_back(propertyOf(lines, words));
    }
    else if (words[0] == "obj_info" && words.size() == 3 && words[1] == "num_cols")
      columns = countOf(lines, words[2]);
    else if (words[0] == "obj_info" && words.size() == 3 && words[1] == "num_rows")
      rows = countOf(lines, words[2]);
    else if (words[0] == "comment" && words.size() > 1)
      comments.push_back(lines.text().substr(words[1].data() - words[0].data()));
    else if (words[0] == "obj_info")
      comments.push_back(lines.text());
    else if (words[0] != "comment")
      lines.failAt(words[0], "is no keyword of a PLY header");
  }
  throw std::runtime_error("the file ends within its header");
}

const PLYHeader::Element*
PLYHeader::find(const std::string& element) const
{
  for (const auto& candidate : elements)
    if (candidate.name == element)
      return &candidate;
  return nullptr;
}

} // namespace tool
