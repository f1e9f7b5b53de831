/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "format_readers.h"
#include "text_lines.h"

#include <pcl/common/io.h>
#include <pcl/io/pcd_io.h>

#include <boost/algorithm/string/classification.hpp>
#include <boost/algorithm/string/split.hpp>
#include <boost/algorithm/string/trim.hpp>
#include <boost/lexical_cast/try_lexical_convert.hpp>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <stdexcept>

namespace tool {
namespace {

/** The header, checked before PCL sees the file: PCL 1.13 crashes on a header that is
 * cut short, and takes rows and compressed data that are cut short for complete ones.
 */
class Header {
public:
  explicit Header(std::istream& stream)
  {
    for (std::string line; !entries_.count("DATA") && std::getline(stream, line);) {
      ++lines_;
      boost::trim(line);
      if (line.empty() || line[0] == '#')
        continue;
      std::vector<std::string> words;
      boost::split(words, line, boost::is_any_of(" \t"), boost::token_compress_on);
      const std::string key = words[0] == "COLUMNS" ? "FIELDS" : words[0];
      words.erase(words.begin());
      entries_[key] = words;
    }
    // A last line without its end may be cut short.
    if (!entries_.count("DATA") || stream.eof())
      throw std::runtime_error("is no PCD file, or the file ends within its header");
  }

  std::size_t
  lines() const
  {
    return lines_;
  }

  /** "ascii", "binary" or "binary_compressed". */
  std::string
  encoding() const
  {
    return words("DATA", 1)[0];
  }

  std::uint64_t
  points() const
  {
    const auto points = numbers("POINTS", 1)[0];
    const auto width = numbers("WIDTH", 1)[0];
    const auto height = numbers("HEIGHT", 1)[0];
    if (points == 0)
      throw std::runtime_error("holds no points");
    if (width == 0 || points % width != 0 || points / width != height ||
        points > std::numeric_limits<std::int32_t>::max())
      throw std::runtime_error("POINTS is not WIDTH times HEIGHT in its header");
    return points;
  }

  /** How many numbers a point has. */
  std::uint64_t
  columns() const
  {
    std::uint64_t columns = 0;
    for (const auto count : counts())
      columns += count;
    return columns;
  }

  /** How many bytes a point has. */
  std::uint64_t
  bytes() const
  {
    const auto count = counts();
    const auto sizes = numbers("SIZE", count.size());
    const auto types = words("TYPE", count.size());
    std::uint64_t bytes = 0;
    for (std::size_t i = 0; i < count.size(); ++i) {
      const bool is_number = types[i] == "F" || types[i] == "I" || types[i] == "U";
      if (!is_number || pcl::getFieldType(sizes[i], types[i][0]) < 0)
        throw std::runtime_error("has a field of unknown TYPE and SIZE " + types[i] +
                                 ' ' + std::to_string(sizes[i]));
      bytes += sizes[i] * count[i];
    }
    return bytes;
  }

private:
  std::vector<std::uint64_t>
  counts() const
  {
    const auto entry = entries_.find("FIELDS");
    if (entry == entries_.end() || entry->second.empty())
      throw std::runtime_error("has no FIELDS in its header");
    const std::size_t fields = entry->second.size();
    if (!entries_.count("COUNT"))
      return std::vector<std::uint64_t>(fields, 1);
    return numbers("COUNT", fields);
  }

  std::vector<std::string>
  words(const std::string& key, std::size_t number) const
  {
    const auto entry = entries_.find(key);
    if (entry == entries_.end() || entry->second.size() != number)
      throw std::runtime_error("has no " + key + " in its header, or not one for each");
    return entry->second;
  }

  std::vector<std::uint64_t>
  numbers(const std::string& key, std::size_t number) const
  {
    std::vector<std::uint64_t> numbers;
    for (const auto& word : words(key, number)) {
      std::uint32_t value;
      if (word[0] == '-' || !boost::conversion::try_lexical_convert(word, value))
        throw std::runtime_error("'" + word + "' is no " + key + " in its header");
      numbers.push_back(value);
    }
    return numbers;
  }

  std::map<std::string, std::vector<std::string>> entries_;
  std::size_t lines_ = 0;
};

/** Check that all data are there that the header announces. */
void
checkComplete(const std::string& path)
{
  std::ifstream stream(path, std::ios::binary);
  const Header header(stream);
  const std::uint64_t size = header.points() * header.bytes();
  const std::uint64_t remaining =
      std::filesystem::file_size(path) - static_cast<std::uint64_t>(stream.tellg());
  bool complete = false;
  if (header.encoding() == "ascii")
    complete = countRows(stream, header.lines(), header.columns()) == header.points();
  else if (header.encoding() == "binary")
    complete = remaining >= size;
  else if (header.encoding() == "binary_compressed") {
    std::uint32_t sizes[2] = {}; // compressed and not
    stream.read(reinterpret_cast<char*>(sizes), sizeof sizes);
    complete = stream && remaining - sizeof sizes >= sizes[0] && sizes[1] == size;
  }
  else
    throw std::runtime_error("has unknown DATA '" + header.encoding() + "'");
  if (!complete)
    throw std::runtime_error(
        "holds fewer or more data than the " + std::to_string(header.points()) +
        " points of its header; the file is damaged or incomplete");
}

} // namespace

Geometry
readPCD(const std::string& path)
{
  checkComplete(path);
  Geometry geometry;
  int version;
  if (pcl::PCDReader().read(path, geometry.cloud, geometry.sensor_origin,
                            geometry.sensor_orientation, version) < 0)
    throw std::runtime_error("the file is damaged");
  return geometry;
}

} // namespace tool
