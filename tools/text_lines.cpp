/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "text_lines.h"

#include <algorithm>
#include <charconv>
#include <stdexcept>
#include <string_view>

namespace tool {
namespace {

constexpr const char* WHITE_SPACE = " \t\r\n\v\f";

std::string_view
trimmed(std::string_view text)
{
  const auto first = text.find_first_not_of(WHITE_SPACE);
  if (first == std::string_view::npos)
    return {};
  return text.substr(first, text.find_last_not_of(WHITE_SPACE) - first + 1);
}

/** Read one number. \return whether the text is a number and nothing else */
bool
parse(std::string_view text, double& number)
{
  // std::from_chars does not know the plus sign.
  if (text.size() > 1 && text[0] == '+' && text[1] != '-')
    text.remove_prefix(1);
  const char* end = text.data() + text.size();
  const auto result = std::from_chars(text.data(), end, number);
  return result.ec == std::errc() && result.ptr == end;
}

} // namespace

TextLines::TextLines(std::istream& stream, Style style, std::size_t lines_before)
: stream_(stream)
, style_(style)
, line_number_(lines_before)
{
}

bool
TextLines::next()
{
  for (std::string line; std::getline(stream_, line);) {
    std::string_view text = line;
    if (line_number_++ == 0 && text.substr(0, 3) == "\xEF\xBB\xBF")
      text.remove_prefix(3); // byte order mark
    if (style_ == Style::FREE)
      text = text.substr(0, text.find('#'));
    text_ = trimmed(text);
    const bool is_comment = style_ == Style::FREE && text_.compare(0, 2, "//") == 0;
    if (!text_.empty() && !is_comment)
      return true;
  }
  return false;
}

const std::string&
TextLines::text() const
{
  return text_;
}

std::string
TextLines::takeWord()
{
  const std::string word = text_.substr(0, text_.find_first_of(WHITE_SPACE));
  text_ = std::string(trimmed(std::string_view(text_).substr(word.size())));
  return word;
}

bool
TextLines::startsWithNumber() const
{
  double number;
  const std::string_view text = text_;
  return parse(trimmed(text.substr(0, text.find_first_of(separators()))), number);
}

const std::vector<double>&
TextLines::numbers()
{
  numbers_.clear();
  const char* separators = this->separators();
  const std::string_view text = text_;
  for (std::size_t begin = 0; begin <= text.size();) {
    const auto end = std::min(text.find_first_of(separators, begin), text.size());
    const std::string_view item = trimmed(text.substr(begin, end - begin));
    begin = end + 1;
    // Blanks may stand in a row, other separators at the end.
    if (item.empty() && (separators == WHITE_SPACE || begin > text.size()))
      continue;
    double number;
    if (!parse(item, number))
      fail("'" + std::string(item.substr(0, 40)) + "' is not a number");
    numbers_.push_back(number);
  }
  return numbers_;
}

const char*
TextLines::separators() const
{
  if (style_ == Style::FREE)
    for (const char* separator : {";", ","})
      if (text_.find(separator) != std::string::npos)
        return separator;
  return WHITE_SPACE;
}

void
TextLines::fail(const std::string& problem) const
{
  throw std::runtime_error("line " + std::to_string(line_number_) + ": " + problem);
}

std::size_t
countRows(std::istream& stream, std::size_t lines_before, std::size_t columns)
{
  TextLines lines(stream, TextLines::Style::STRICT, lines_before);
  std::size_t rows = 0;
  for (; lines.next(); ++rows)
    if (lines.numbers().size() != columns && columns != 0)
      lines.fail("has " + std::to_string(lines.numbers().size()) +
                 " numbers instead of " + std::to_string(columns) +
                 "; the file is damaged or incomplete");
  return rows;
}

} // namespace tool
