/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "text_rows.h"

#include "numbers.h"
#include "white_space.h"

#include <boost/algorithm/string/predicate.hpp>

#include <algorithm>
#include <limits>

namespace tool {
namespace {

std::string_view
unquoted(std::string_view word)
{
  if (word.size() >= 2 && word.front() == word.back() &&
      (word.front() == '"' || word.front() == '\''))
    return trimmed(word.substr(1, word.size() - 2));
  return word;
}

bool
separates(char c, Delimiter delimiter)
{
  switch (delimiter) {
  case Delimiter::WHITE:
    return isWhite(c);
  case Delimiter::TAB:
    return c == '\t';
  case Delimiter::COMMA:
    return c == ',';
  case Delimiter::SEMICOLON:
    return c == ';';
  }
  return false;
}

bool
isMissing(std::string_view word)
{
  for (const char* name : {"", "NA", "N/A", "null", "none", "nodata"})
    if (boost::algorithm::iequals(word, name))
      return true;
  return false;
}

/** Read a number with a comma before its fraction. */
bool
parseWithComma(std::string_view word, double& number)
{
  char copy[64];
  if (word.size() > sizeof copy || word.find('.') != std::string_view::npos ||
      std::count(word.begin(), word.end(), ',') > 1)
    return false;
  std::replace_copy(word.begin(), word.end(), copy, ',', '.');
  return parseNumber({copy, word.size()}, number);
}

bool
has(std::string_view text, char c)
{
  return text.find(c) != std::string_view::npos;
}

/** Whether the commas of a row stand within its numbers, which spaces separate. */
bool
hasDecimalCommas(std::string_view row)
{
  std::vector<std::string_view> words;
  splitColumns(row, Delimiter::WHITE, words);
  double ignored;
  return words.size() >= 3 && has(row, ',') && !has(row, '.') &&
         std::all_of(words.begin(), words.end(), [&](std::string_view word) {
           return parseWithComma(word, ignored) && word.back() != ',';
         });
}

Delimiter
delimiterOf(std::string_view row)
{
  if (has(row, ';'))
    return Delimiter::SEMICOLON;
  return has(row, ',') && !hasDecimalCommas(row) ? Delimiter::COMMA : Delimiter::WHITE;
}

} // namespace

void
splitColumns(std::string_view line,
             Delimiter delimiter,
             std::vector<std::string_view>& words)
{
  words.clear();
  const char *here = line.data(), *const end = here + line.size();
  const bool has_quotes = has(line, '"');
  const auto next_separator = [&](const char* from) {
    bool is_quoted = false;
    return std::find_if(from, end, [&](char c) {
      is_quoted = is_quoted != (has_quotes && c == '"');
      return !is_quoted && separates(c, delimiter);
    });
  };
  if (delimiter == Delimiter::WHITE) {
    while (here != end) {
      const char* word = std::find_if_not(here, end, isWhite);
      here = has_quotes ? next_separator(word) : std::find_if(word, end, isWhite);
      if (word != here)
        words.push_back(unquoted({word, static_cast<std::size_t>(here - word)}));
    }
    return;
  }
  for (;;) {
    const char* separator = next_separator(here);
    words.push_back(
        unquoted(trimmed({here, static_cast<std::size_t>(separator - here)})));
    if (separator == end)
      return;
    here = separator + 1;
  }
}

RowFormat::RowFormat(std::string_view first_row)
: RowFormat(first_row, delimiterOf(first_row))
{
}

RowFormat::RowFormat(std::string_view first_row, Delimiter delimiter)
: delimiter_(delimiter)
, decimal_(Decimal::OPEN)
{
  // Numbers between spaces that are all whole say that they have no decimal commas.
  if (delimiter == Delimiter::WHITE && !has(first_row, '\t'))
    decimal_ = has(first_row, ',') ? Decimal::COMMA : Decimal::POINT;
}

bool
RowFormat::parse(std::string_view word, double& number)
{
  if (parseNumber(word, number)) {
    if (decimal_ == Decimal::POINT || !has(word, '.'))
      return true;
    // 1.234 among decimal commas may be more than a thousand
    const bool was_open = decimal_ == Decimal::OPEN;
    if (was_open)
      decimal_ = Decimal::POINT;
    return was_open || has(word, '#');
  }
  if (isMissing(word)) {
    number = std::numeric_limits<double>::quiet_NaN();
    return true;
  }
  if (decimal_ == Decimal::POINT || !parseWithComma(word, number))
    return false;
  decimal_ = Decimal::COMMA;
  return true;
}

} // namespace tool
