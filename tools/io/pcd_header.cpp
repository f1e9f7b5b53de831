/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "pcd_header.h"

#include "fields.h"
#include "numbers.h"

#include <pcl/common/io.h>

#include <boost/algorithm/string/case_conv.hpp>

#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <stdexcept>

namespace tool {
namespace {

/** The words behind each keyword of a header. */
class Entries {
public:
  explicit Entries(TextLines& lines)
  {
    while (entries_.count("DATA") == 0) {
      if (!lines.next())
        throw std::runtime_error("is no PCD file, or the file ends within its header");
      if (lines.text()[0] == '#') {
        addComment(lines.text());
        continue;
      }
      const auto& words = lines.words();
      const std::string key(words[0] == "COLUMNS" ? "FIELDS" : words[0]);
      static const std::set<std::string> keys{
          "VERSION", "FIELDS", "SIZE",      "TYPE",   "COUNT",
          "WIDTH",   "HEIGHT", "VIEWPOINT", "POINTS", "DATA"};
      if (keys.count(key) == 0)
        lines.failAt(key, "is no keyword of a PCD header");
      if (!entries_
               .emplace(key, std::vector<std::string>(words.begin() + 1, words.end()))
               .second)
        lines.failAt(key, "is in the header twice");
    }
  }

  bool
  has(const std::string& key) const
  {
    return entries_.count(key) > 0;
  }

  const std::vector<std::string>&
  words(const std::string& key) const
  {
    static const std::vector<std::string> none;
    const auto entry = entries_.find(key);
    return entry == entries_.end() ? none : entry->second;
  }

  /** So many words. */
  const std::vector<std::string>&
  words(const std::string& key, std::size_t number) const
  {
    if (words(key).size() != number)
      throw std::runtime_error("has no " + key + " in its header, or not one for each");
    return words(key);
  }

  /** So many numbers that are not negative and fit into 31 bits. */
  std::vector<std::uint32_t>
  counts(const std::string& key, std::size_t number) const
  {
    std::vector<std::uint32_t> counts;
    for (const auto& word : words(key, number)) {
      std::int64_t value;
      if (!parseNumber(word, value) || value < 0 ||
          value > std::numeric_limits<std::int32_t>::max())
        throw std::runtime_error("'" + word.substr(0, 40) + "' is no " + key +
                                 " in its header");
      counts.push_back(static_cast<std::uint32_t>(value));
    }
    return counts;
  }

  /** The lines that begin with a #, but for the one that names the format. */
  std::vector<std::string> comments;

private:
  void
  addComment(const std::string& line)
  {
    const auto start = line.find_first_not_of("# \t");
    if (start != std::string::npos && line.compare(start, 4, ".PCD") != 0)
      comments.push_back(line.substr(start));
  }

  std::map<std::string, std::vector<std::string>> entries_;
};

int
datatypeOf(std::uint32_t size, const std::string& type)
{
  const bool is_number = type == "F" || type == "I" || type == "U";
  const int datatype =
      is_number && size <= 8 ? pcl::getFieldType(static_cast<int>(size), type[0]) : -1;
  if (datatype < 0)
    throw std::runtime_error("has a field of unknown TYPE and SIZE " +
                             type.substr(0, 40) + ' ' + std::to_string(size));
  return datatype;
}

} // namespace

PCDHeader::PCDHeader(TextLines& lines)
{
  const Entries entries(lines);
  comments = entries.comments;
  const auto& names = entries.words("FIELDS");
  if (names.empty())
    throw std::runtime_error("has no FIELDS in its header");
  checkNames(names);
  const auto sizes = entries.counts("SIZE", names.size());
  const auto& types = entries.words("TYPE", names.size());
  const auto counts = entries.has("COUNT")
                          ? entries.counts("COUNT", names.size())
                          : std::vector<std::uint32_t>(names.size(), 1);
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (counts[i] == 0)
      throw std::runtime_error("the COUNT of '" + names[i].substr(0, 40) +
                               "' is 0 in its header");
    pcl::PCLPointField field;
    field.name = names[i];
    field.datatype = static_cast<std::uint8_t>(datatypeOf(sizes[i], types[i]));
    field.count = counts[i];
    field.offset = static_cast<std::uint32_t>(point_step);
    fields.push_back(field);
    point_step += std::uint64_t(sizes[i]) * counts[i];
    if (point_step > std::numeric_limits<std::int32_t>::max())
      throw std::runtime_error("its points are too large, by SIZE and COUNT");
  }

  // Two of these tell the third, and most clouds have one row.
  const auto count = [&](const char* key, std::uint64_t otherwise) -> std::uint64_t {
    return entries.has(key) ? entries.counts(key, 1)[0] : otherwise;
  };
  if (!entries.has("POINTS") && !entries.has("WIDTH"))
    throw std::runtime_error("has neither POINTS nor WIDTH in its header");
  height = count("HEIGHT", 1);
  if (entries.has("WIDTH") && entries.has("POINTS") && !entries.has("HEIGHT"))
    height = count("POINTS", 0) / std::max<std::uint64_t>(count("WIDTH", 0), 1);
  width = count("WIDTH", count("POINTS", 0) / std::max<std::uint64_t>(height, 1));
  points = count("POINTS", width * height);
  if (points == 0)
    throw std::runtime_error("holds no points");
  if (points > std::numeric_limits<std::int32_t>::max())
    throw std::runtime_error("has more points than can be read");
  if (width * height != points)
    throw std::runtime_error("POINTS is not WIDTH times HEIGHT in its header");

  if (entries.has("VIEWPOINT")) {
    const auto& words = entries.words("VIEWPOINT", 7);
    float view[7];
    for (std::size_t i = 0; i < 7; ++i)
      if (!parseNumber(words[i], pcl::PCLPointField::FLOAT32,
                       reinterpret_cast<std::uint8_t*>(&view[i])))
        throw std::runtime_error("'" + words[i].substr(0, 40) +
                                 "' is no VIEWPOINT in its header");
    sensor_origin << view[0], view[1], view[2], 0.0f;
    sensor_orientation = Eigen::Quaternionf(view[3], view[4], view[5], view[6]);
  }

  const std::string data = boost::algorithm::to_lower_copy(entries.words("DATA", 1)[0]);
  static const std::map<std::string, Encoding> encodings{
      {"ascii", Encoding::ASCII},
      {"binary", Encoding::BINARY},
      {"binary_compressed", Encoding::COMPRESSED}};
  const auto found = encodings.find(data);
  if (found == encodings.end())
    throw std::runtime_error("has unknown DATA '" + data.substr(0, 40) + "'");
  encoding = found->second;
}

} // namespace tool
