/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "text_lines.h"

#include "numbers.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace tool {
namespace {

constexpr const char* WHITE_SPACE = " \t\r\n\v\f";

bool
isWhite(char character)
{
  return character == ' ' || (character >= '\t' && character <= '\r');
}

/** A file that is no text need not have ends of lines. */
constexpr std::size_t LONGEST_LINE = 1 << 24;

std::string_view
trimmed(std::string_view text)
{
  while (!text.empty() && isWhite(text.front()))
    text.remove_prefix(1);
  while (!text.empty() && isWhite(text.back()))
    text.remove_suffix(1);
  return text;
}

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

/** The text before its comment. No # starts one in 1.#QNAN, as some programs write what
 * is no number. */
std::string_view
withoutComment(std::string_view text)
{
  auto at = text.find('#');
  while (at != std::string_view::npos && at > 0 && text[at - 1] == '.')
    at = text.find('#', at + 1);
  return text.substr(0, at);
}

} // namespace

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
  if (style_ == Style::FREE || style_ == Style::COMMENTED)
    text = withoutComment(text);
  text_ = trimmed(text);
  if (style_ == Style::FREE && text_.compare(0, 2, "//") == 0)
    text_.clear();
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
  std::string before = text_;
  before.back() = ' ';
  if (!readLine())
    text_.clear();
  text_ = before + text_;
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

void
TextLines::cutComment()
{
  const auto size = withoutComment(text_).size();
  if (size < text_.size())
    text_ = std::string(trimmed(std::string_view(text_).substr(0, size)));
}

bool
TextLines::startsWithNumber() const
{
  double number;
  const std::string_view text = text_;
  const std::string_view word =
      trimmed(text.substr(0, text.find_first_of(separators())));
  return parseNumber(word, number) ||
         (!word.empty() && word.find_first_of("+-.0123456789") == 0);
}

const std::vector<std::string_view>&
TextLines::words()
{
  words_.clear();
  const char* separators = this->separators();
  const std::string_view text = text_;
  if (separators == WHITE_SPACE) {
    for (const char *here = text.data(), *end = here + text.size(); here != end;) {
      const char* word = std::find_if_not(here, end, isWhite);
      here = std::find_if(word, end, isWhite);
      if (word != here)
        words_.push_back({word, static_cast<std::size_t>(here - word)});
    }
    return words_;
  }
  for (std::size_t begin = 0; begin <= text.size();) {
    const auto end = std::min(text.find(*separators, begin), text.size());
    words_.push_back(trimmed(text.substr(begin, end - begin)));
    begin = end + 1;
  }
  if (!words_.empty() && words_.back().empty()) // a separator may stand at the end
    words_.pop_back();
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
