/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "manifest.h"

#include "command_line/quantities.h"
#include "csv.h"

#include <boost/algorithm/string/join.hpp>
#include <boost/algorithm/string/trim.hpp>
#include <boost/crc.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <iterator>
#include <stdexcept>
#include <tuple>
#include <utility>

namespace tool {
namespace {

/** What a manifest says of a pair. */
struct Column {
  const char* name;
  std::string Pair::*member;
};

constexpr Column COLUMNS[] = {{"source", &Pair::source},
                              {"target", &Pair::target},
                              {"name", &Pair::name},
                              {"guess", &Pair::guess}};

const Column&
columnOf(const std::string& name)
{
  const auto found =
      std::find_if(std::begin(COLUMNS), std::end(COLUMNS),
                   [&](const Column& column) { return column.name == name; });
  if (found == std::end(COLUMNS))
    throw std::runtime_error("there is no column '" + name +
                             "'; use source, target, name and guess, with commas "
                             "between them");
  return *found;
}

void
check(const Pair& pair)
{
  for (const Column& column : {COLUMNS[0], COLUMNS[1]})
    if ((pair.*column.member).empty())
      throw std::runtime_error(std::string("names no ") + column.name);
  for (const Column& column : COLUMNS)
    if ((pair.*column.member).find('\0') != std::string::npos)
      throw std::runtime_error(std::string("has a zero byte in its ") + column.name);
}

/** The columns that the header of a CSV names, in their order. */
std::vector<Column>
columnsOf(const std::string& header)
{
  std::vector<Column> columns;
  for (std::string name : fieldsOf(header)) {
    boost::algorithm::trim(name);
    const Column& column = columnOf(name);
    for (const Column& other : columns)
      if (other.name == name)
        throw std::runtime_error("the column '" + name + "' is there twice");
    columns.push_back(column);
  }
  for (const char* name : {"source", "target"})
    if (std::none_of(columns.begin(), columns.end(), [&](const Column& column) {
          return column.name == std::string(name);
        }))
      throw std::runtime_error("lacks '" + std::string(name) + "'");
  return columns;
}

Pair
pairOfCSV(const std::vector<Column>& columns, const std::string& record)
{
  const std::vector<std::string> fields = fieldsOf(record);
  if (fields.size() != columns.size())
    throw std::runtime_error("has " + counted(fields.size(), "field") +
                             ", but there are " + counted(columns.size(), "column"));
  Pair pair;
  for (std::size_t i = 0; i < fields.size(); ++i)
    pair.*columns[i].member = fields[i];
  check(pair);
  return pair;
}

Pair
pairOfJSON(const std::string& record)
{
  const auto object = nlohmann::json::parse(record, nullptr, false);
  if (!object.is_object())
    throw std::runtime_error("is no JSON object");
  Pair pair;
  for (const auto& [key, value] : object.items()) {
    const Column& column = columnOf(key);
    if (!value.is_string())
      throw std::runtime_error("'" + key + "' is no string");
    pair.*column.member = value.get<std::string>();
  }
  check(pair);
  return pair;
}

/** The length of a file, and its checksum. */
std::pair<std::uint64_t, std::uint32_t>
measure(std::istream& file)
{
  boost::crc_32_type checksum;
  std::uint64_t bytes = 0;
  for (char block[65536]; file;) {
    file.read(block, sizeof block);
    checksum.process_bytes(block, static_cast<std::size_t>(file.gcount()));
    bytes += static_cast<std::uint64_t>(file.gcount());
  }
  file.clear();
  file.seekg(0);
  return {bytes, checksum.checksum()};
}

bool
isBlank(const std::string& record)
{
  return record.find_first_not_of(" \t\r") == std::string::npos;
}

} // namespace

Manifest::Manifest(const std::string& path)
: path_(path)
{
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    fail("is no regular file, as a list of pairs has to be");
  errno = 0;
  file_.open(path, std::ios::binary);
  if (!file_)
    fail(std::strerror(errno));
  std::tie(bytes_, checksum_) = measure(file_);
  read();
}

void
Manifest::checkUnchanged() const
{
  std::ifstream file(path_, std::ios::binary);
  if (measure(file) != std::make_pair(bytes_, checksum_))
    fail("has changed while its pairs were registered; start again with --restart");
}

void
Manifest::read()
{
  std::string mark(3, '\0');
  file_.read(mark.data(), 3);
  file_.clear();
  file_.seekg(mark == "\xEF\xBB\xBF" ? 3 : 0);
  if (mark[0] == '[')
    fail("is a JSON list; write each object in a line of its own, without brackets");
  for (const char* other : {"\xFE\xFF", "\xFF\xFE"})
    if (mark.find(other) == 0)
      fail("is in UTF-16; save it as UTF-8");

  constexpr std::size_t MOST = 20;
  std::vector<std::string> mistakes;
  bool has_header = false;
  std::string record;
  for (std::size_t line = 0; mistakes.size() < MOST;) {
    const auto place = static_cast<std::uint64_t>(file_.tellg());
    const std::size_t first = line + 1;
    const bool is_there = is_json_ ? (++line, bool(std::getline(file_, record)))
                                   : readRecord(file_, record, line);
    if (!is_there)
      break;
    if (isBlank(record))
      continue;
    try {
      if (!has_header) {
        has_header = true;
        is_json_ = record[record.find_first_not_of(" \t")] == '{';
        if (is_json_)
          pairOf_ = pairOfJSON;
        else {
          pairOf_ = [columns = columnsOf(record)](const std::string& row) {
            return pairOfCSV(columns, row);
          };
          continue;
        }
      }
      pairOf_(record);
      places_.push_back(place);
    }
    catch (const std::exception& problem) {
      mistakes.push_back("line " + std::to_string(first) +
                         (pairOf_ ? ": " : ", which names the columns: ") +
                         problem.what());
      if (!pairOf_)
        break; // without the header nothing is right
    }
  }
  if (file_.bad())
    fail("cannot be read to its end");
  if (!mistakes.empty())
    fail(boost::algorithm::join(mistakes, "; ") +
         (mistakes.size() == MOST ? "; and maybe more" : ""));
  if (places_.empty())
    fail("holds no pairs");
  file_.clear();
}

Pair
Manifest::operator[](std::size_t number) const
{
  std::string record;
  std::size_t line = 0;
  file_.clear();
  file_.seekg(static_cast<std::streamoff>(places_.at(number)));
  if (!(is_json_ ? bool(std::getline(file_, record)) : readRecord(file_, record, line)))
    fail("cannot be read again");
  return pairOf_(record);
}

void
Manifest::fail(const std::string& problem) const
{
  throw std::runtime_error(path_ + ": " + problem);
}

} // namespace tool
