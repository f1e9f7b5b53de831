/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "csv.h"

#include <algorithm>
#include <stdexcept>

namespace tool {

bool
readRecord(std::istream& stream, std::string& record, std::size_t& line)
{
  record.clear();
  std::string part;
  if (!std::getline(stream, part))
    return false;
  ++line;
  record = part;
  // a quote that is open at the end of a line takes in the next one
  while (std::count(record.begin(), record.end(), '"') % 2 == 1 &&
         std::getline(stream, part)) {
    ++line;
    record += '\n' + part;
  }
  if (!record.empty() && record.back() == '\r')
    record.pop_back();
  return true;
}

std::vector<std::string>
fieldsOf(const std::string& record)
{
  std::vector<std::string> fields;
  for (std::size_t i = 0;; ++i) {
    std::string field;
    if (i < record.size() && record[i] == '"') {
      for (++i;; ++i) {
        if (i >= record.size())
          throw std::runtime_error("a quote is not closed");
        if (record[i] != '"')
          field += record[i];
        else if (i + 1 < record.size() && record[i + 1] == '"')
          field += record[i++];
        else
          break;
      }
      if (++i < record.size() && record[i] != ',')
        throw std::runtime_error("a comma is missing after a quoted field");
    }
    else
      for (; i < record.size() && record[i] != ','; ++i) {
        if (record[i] == '"')
          throw std::runtime_error(
              "a field with quotes in it has to be quoted, and the "
              "quotes in it doubled");
        field += record[i];
      }
    fields.push_back(std::move(field));
    if (i >= record.size())
      return fields;
  }
}

std::string
asField(const std::string& text)
{
  if (text.find_first_of(",\"\r\n") == std::string::npos)
    return text;
  std::string quoted = "\"";
  for (const char c : text)
    quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

} // namespace tool
