/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "ply_header.h"

#include <map>
#include <sstream>
#include <stdexcept>

namespace tool {
namespace {

std::uint64_t
bytesOf(const std::string& type)
{
  static const std::map<std::string, std::uint64_t> bytes{
      {"char", 1},  {"int8", 1},    {"uchar", 1},  {"uint8", 1},
      {"short", 2}, {"int16", 2},   {"ushort", 2}, {"uint16", 2},
      {"int", 4},   {"int32", 4},   {"uint", 4},   {"uint32", 4},
      {"float", 4}, {"float32", 4}, {"double", 8}, {"float64", 8}};
  const auto entry = bytes.find(type);
  if (entry == bytes.end())
    throw std::runtime_error("has a property of unknown type '" + type + "'");
  return entry->second;
}

/** Read a count that must not be negative. */
std::uint64_t
count(std::istream& words)
{
  std::int64_t number;
  if (!(words >> number) || number < 0)
    throw std::runtime_error("has an unreadable number in its header");
  return static_cast<std::uint64_t>(number);
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
PLYHeader::Element::leastBytes() const
{
  std::uint64_t sum = 0;
  for (const auto& property : properties)
    sum += bytesOf(property.length_type.empty() ? property.type : property.length_type);
  return sum;
}

PLYHeader::PLYHeader(std::istream& stream)
{
  bool ended = false;
  for (std::string line; !ended && std::getline(stream, line);) {
    std::istringstream words(line);
    std::string key, word;
    words >> key;
    if (++lines == 1 && key != "ply")
      throw std::runtime_error("is no PLY file");
    if (key == "format")
      ascii = words >> word && word == "ascii";
    else if (key == "element") {
      words >> word;
      elements.push_back({word, count(words), {}});
    }
    else if (key == "property" && !elements.empty()) {
      Property property;
      words >> property.type;
      if (property.type == "list")
        words >> property.length_type >> property.type;
      words >> property.name;
      elements.back().properties.push_back(property);
    }
    else if (key == "obj_info" && words >> word) {
      if (word == "num_cols")
        columns = count(words);
      if (word == "num_rows")
        rows = count(words);
    }
    ended = key == "end_header";
  }
  // A last line without its end may be cut short.
  if (!ended || stream.eof())
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
