/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "run_log.h"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <stdexcept>

namespace evaluation {
namespace {

constexpr const char* key_fields[] = {"condition", "model", "repetition", "method",
                                      "scale_given"};

/** \brief The part of a record by which it is found. */
std::string
keyOf(const Record& record)
{
  std::string key;
  for (const char* field : key_fields)
    key += record.at(field).dump() + ' ';
  return key;
}

bool
isRecord(const Record& record)
{
  if (!record.is_object())
    return false;
  return std::all_of(std::begin(key_fields), std::end(key_fields),
                     [&](const char* field) { return record.contains(field); });
}

bool
fileHolds(const std::string& path, std::size_t bytes)
{
  std::error_code none;
  const auto size = std::filesystem::file_size(path, none);
  return none ? bytes == 0 : size == bytes;
}

} // namespace

RunLog::RunLog(const std::string& path)
{
  const std::string whole_lines = read(path);
  if (fileHolds(path, whole_lines.size())) {
    file_.open(path, std::ios::app);
  }
  else { // the last line was cut short; the others must not be lost
    const std::string mended = path + ".mended";
    std::ofstream(mended) << whole_lines;
    std::filesystem::rename(mended, path);
    file_.open(path, std::ios::app);
  }
  if (!file_)
    throw std::runtime_error(path + ": cannot be written");
}

std::string
RunLog::read(const std::string& path)
{
  std::ifstream file(path);
  std::string whole_lines, line;
  for (std::size_t number = 1; std::getline(file, line); ++number) {
    const Record record = Record::parse(line, nullptr, false);
    if (record.is_discarded() && file.peek() == std::ifstream::traits_type::eof())
      break;
    if (!isRecord(record))
      throw std::runtime_error(path + ", line " + std::to_string(number) +
                               ": is no result of a run; remove the line");
    records_[keyOf(record)] = record;
    whole_lines += line + '\n';
  }
  return whole_lines;
}

const Record*
RunLog::find(const Run& run) const
{
  const auto found = records_.find(keyOf(evaluation::keyOf(run)));
  return found == records_.end() ? nullptr : &found->second;
}

void
RunLog::add(const Record& record)
{
  records_[keyOf(record)] = record;
  file_ << lineOf(record) << '\n' << std::flush;
  if (!file_)
    throw std::runtime_error(
        "the log of the runs cannot be written: is the disk full?");
}

} // namespace evaluation
