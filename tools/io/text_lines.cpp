/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "text_lines.h"

#include "numbers.h"
#include "white_space.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace tool {
namespace {

constexpr const char* WHITE_SPACE = " \t\r\n\v\f";

bool
isSpace(char character)
{
  return character == ' ' || character == '\r';
}

/** A file that is no text need not have ends of lines. */
constexpr std::size_t LONGEST_LINE = 1 << 24;

/** What ends the first line, and so all others: old Macs have carriage returns alone.
 */
char
endOfLine(std::istream& stream)
{
  const auto here = stream.tellg();
  char piece[4096];
  const auto size = stream.read(piece, sizeof piece).gcount();
  stream.clear();
  stream.seekg(here);
  const std::string_view text(piece, static_cast<std::size_t>(size));
  const auto first = text.find_first_of("\r\n");
  const bool is_alone = first != std::string_view::npos && text[first] == '\r' &&
                        text.substr(first + 1, 1) != "\n" &&
                        first + 1 < sizeof piece; // where nobody can tell
  return is_alone ? '\r' : '\n';
}

} // namespace

std::string_view
withoutComment(std::string_view text)
{
  auto at = text.find('#');
  while (at != std::string_view::npos && at > 0 && !isWhite(text[at - 1]))
    at = text.find('#', at + 1);
  return text.substr(0, at);
}

TextLines::TextLines(std::istream& stream, Style style)
: stream_(stream)
, style_(style)
, end_of_line_(endOfLine(stream))
{
}

bool
TextLines::readLine()
{
  ++line_number_;
  line_.clear();
  for (char piece[4096];
       stream_.getline(piece, sizeof piece, end_of_line_).gcount() > 0;) {
    const bool has_end = !stream_.eof() && !stream_.fail();
    line_.append(piece, stream_.gcount() - (has_end ? 1 : 0));
    if (has_end || stream_.eof())
      break;
    if (line_.size() > LONGEST_LINE)
      fail("is too long for a line of text");
    stream_.clear(); // the line is longer than the piece
  }
  if (line_.empty() && stream_.fail())
    return false;
  std::string_view text = line_;
  if (line_number_ == 1 && text.substr(0, 3) == "\xEF\xBB\xBF") {
    if (style_ == Style::STRICT)
      fail("starts with a byte order mark; save the file without it");
    text.remove_prefix(3);
  }
  if (style_ == Style::COMMENTED)
    text = withoutComment(text);
  const std::string_view inner = trimmed(text);
  if (style_ == Style::COLUMNS && !inner.empty()) {
    while (isSpace(text.front()))
      text.remove_prefix(1);
    while (isSpace(text.back()))
      text.remove_suffix(1);
    text_ = text;
  }
  else
    text_ = inner;
  return true;
}

bool
TextLines::next()
{
  while (readLine())
    if (!text_.empty())
      return true;
  text_.clear();
  return false;
}

void
TextLines::join()
{
  std::string before = std::move(text_);
  before.back() = ' ';
  if (!readLine())
    text_.clear();
  if (before.size() + text_.size() > LONGEST_LINE)
    fail("is too long for a line of text");
  before += text_;
  text_ = std::move(before);
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

void
TextLines::putBack(const std::string& word)
{
  text_ = std::string(trimmed(word + ' ' + text_));
}

bool
TextLines::startsWithNumber() const
{
  double number;
  const std::string_view text = text_;
  const std::string_view word = text.substr(0, text.find_first_of(WHITE_SPACE));
  return parseNumber(word, number) ||
         (!word.empty() && word.find_first_of("+-.0123456789") == 0);
}

const std::vector<std::string_view>&
TextLines::words()
{
  words_.clear();
  for (const char *here = text_.data(), *end = here + text_.size(); here != end;) {
    const char* word = std::find_if_not(here, end, isWhite);
    here = std::find_if(word, end, isWhite);
    if (word != here)
      words_.push_back({word, static_cast<std::size_t>(here - word)});
  }
  return words_;
}

const std::vector<double>&
TextLines::numbers(std::size_t first)
{
  numbers_.clear();
  const auto& words = this->words();
  for (std::size_t i = first; i < words.size(); ++i) {
    double number;
    if (!parseNumber(words[i], number))
      failAt(words[i], "is not a number");
    if (std::isfinite(number) && std::abs(number) > std::numeric_limits<float>::max())
      failAt(words[i], "is larger than single precision can hold");
    numbers_.push_back(number);
  }
  return numbers_;
}

void
TextLines::failAt(std::string_view word, const std::string& problem) const
{
  fail("'" + std::string(word.substr(0, 40)) + "' " + problem);
}

void
TextLines::fail(const std::string& problem) const
{
  throw std::runtime_error("line " + std::to_string(line_number_) + ": " + problem);
}

} // namespace tool
