/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "text_header.h"

#include "column_names.h"
#include "numbers.h"
#include "text_lines.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <stdexcept>

namespace tool {
namespace {

constexpr Delimiter DELIMITERS[] = {Delimiter::SEMICOLON, Delimiter::TAB,
                                    Delimiter::COMMA, Delimiter::WHITE};

using Words = std::vector<std::string>;

/** More columns than any file has that this is meant for. */
constexpr std::size_t MOST_COLUMNS = 1000;

bool
isUnit(const std::string& word)
{
  return word.size() > 2 && std::string("[({").find(word.front()) < 3 &&
         std::string("])}").find(word.back()) < 3;
}

bool
isMark(const std::string& word)
{
  return std::none_of(word.begin(), word.end(),
                      [](unsigned char c) { return std::isalnum(c) || c >= 0x80; });
}

/** Whether cells are the numbers of columns: 0, 1, 2, ... behind an empty one, under
 * which the numbers of the rows stand. */
bool
numberColumns(const Words& cells)
{
  if (cells.size() < 4 || !cells[0].empty())
    return false;
  for (std::size_t i = 1; i < cells.size(); ++i)
    if (cells[i] != std::to_string(i - 1))
      return false;
  return true;
}

/** The words of a title, without units that spaces set apart: x [m] y [m] z [m].
 * \param[in] columns how many the rows have
 */
Words
wordsOf(const Title& title, Delimiter delimiter, std::size_t columns)
{
  std::vector<std::string_view> found;
  splitColumns(title.text, delimiter, found);
  if (found.size() > columns) // perhaps with a comment
    splitColumns(withoutComment(title.text), delimiter, found);
  if (!found.empty() && found.back().empty()) // a delimiter may stand at the end
    found.pop_back();
  Words words(found.begin(), found.end());
  if (delimiter == Delimiter::WHITE)
    words.erase(std::remove_if(words.begin(), words.end(), isUnit), words.end());
  else if (numberColumns(words))
    std::copy_n(std::array<const char*, 4>{"row", "x", "y", "z"}.begin(), 4,
                words.begin());
  // a mark, or a word, before the names: "columns: x y z"
  if (words.size() == columns + 1 && (isMark(words[0]) || words[0].back() == ':'))
    words.erase(words.begin());
  return words;
}

bool
isPosition(const std::string& name)
{
  return name == "x" || name == "y" || name == "z";
}

/** Whether x, y and z are next to each other; in prose they hardly are. */
bool
areNeighbours(const Words& names)
{
  std::size_t first = names.size(), last = 0;
  for (std::size_t i = 0; i < names.size(); ++i)
    if (isPosition(names[i])) {
      first = std::min(first, i);
      last = i;
    }
  return first + 2 == last;
}

/** The names in a title, as fieldNames() gives them. */
Words
namesIn(const Title& title, Delimiter delimiter, std::size_t columns)
{
  const Words words = wordsOf(title, delimiter, columns);
  if (words.size() < 3 || words.size() > MOST_COLUMNS)
    return {};
  const Words names = fieldNames(words);
  const bool is_prose =
      !title.mark.empty() && delimiter == Delimiter::WHITE && !areNeighbours(names);
  return is_prose ? Words() : names;
}

bool
isNumber(std::string_view word)
{
  double ignored;
  return parseNumber(word, ignored);
}

/** Whether a line has numbers where a title has x, y and z. */
bool
isRowBelow(const Title& title, std::string_view line, Delimiter delimiter)
{
  std::vector<std::string_view> words;
  splitColumns(line, delimiter, words);
  RowFormat format(line, delimiter);
  double ignored;
  if (std::count_if(words.begin(), words.end(), [&](std::string_view word) {
        return !word.empty() && format.parse(word, ignored);
      }) < 3)
    return false;
  try {
    const Words names = namesIn(title, delimiter, words.size());
    if (names.size() != words.size())
      return false;
    for (std::size_t i = 0; i < names.size(); ++i)
      if (isPosition(names[i]) &&
          (words[i].empty() || !format.parse(words[i], ignored)))
        return false;
    return true;
  }
  catch (const std::runtime_error&) {
    return false;
  }
}

/** Whether a line is a name with a point behind it: no prose has three numbers there,
 * and fractions among them. */
bool
isNamedPoint(std::string_view line)
{
  RowFormat format(line);
  std::vector<std::string_view> cells;
  splitColumns(line, format.delimiter(), cells);
  double ignored;
  if (cells.size() < 4 || format.parse(cells[0], ignored))
    return false;
  bool has_fraction = false;
  for (std::size_t i = 1; i < 4; ++i) {
    if (cells[i].empty() || !format.parse(cells[i], ignored))
      return false;
    has_fraction =
        has_fraction || cells[i].find_first_of(".,") != std::string_view::npos;
  }
  return has_fraction;
}

/** The delimiters that titles may have, that of the rows first. */
std::vector<Delimiter>
startingWith(Delimiter delimiter)
{
  std::vector<Delimiter> delimiters{delimiter};
  delimiters.insert(delimiters.end(), std::begin(DELIMITERS), std::end(DELIMITERS));
  return delimiters;
}

} // namespace

std::string
commentMark(std::string_view line)
{
  for (const char* mark : {"//", "#", "%", "!"})
    if (line.substr(0, std::string_view(mark).size()) == mark)
      return mark;
  return "";
}

std::optional<TextHeader>
headerOf(const std::vector<Title>& titles, Delimiter delimiter, std::size_t columns)
{
  if (columns < 3 || columns > MOST_COLUMNS)
    return std::nullopt;
  std::string problem;
  std::optional<TextHeader> of_other_size;
  for (auto title = titles.rbegin(); title != titles.rend(); ++title)
    for (const auto candidate : startingWith(delimiter))
      try {
        const Words names = namesIn(*title, candidate, columns);
        if (names.empty())
          continue;
        const bool is_start = names[0] == "x" && names[1] == "y" && names[2] == "z";
        const bool is_start_of_row =
            candidate == Delimiter::WHITE && is_start && names.size() < columns;
        TextHeader header{names, title->mark, title->line, is_start_of_row};
        if (names.size() == columns)
          return header;
        // R quotes names, and has none for the column of the names of rows
        if (names.size() + 1 == columns && title->text.find('"') != std::string::npos) {
          header.names = namesBehindRow(names);
          return header;
        }
        // prose is no header because it has an x, y and z
        if (!of_other_size &&
            (title->mark.empty() || (is_start && names.size() < columns)))
          of_other_size = header;
      }
      catch (const std::runtime_error& error) {
        if (title->mark.empty())
          problem = "line " + std::to_string(title->line) + ": " + error.what();
      }
  if (!of_other_size && !problem.empty())
    throw std::runtime_error(problem);
  return of_other_size;
}

bool
namesAll(const std::vector<Title>& titles, Delimiter delimiter, std::size_t columns)
{
  try {
    const auto header = headerOf(titles, delimiter, columns);
    return header && header->names.size() == columns;
  }
  catch (const std::runtime_error&) {
    return false;
  }
}

std::vector<std::string>
namesBehindRow(std::vector<std::string> names)
{
  names.insert(names.begin(), "row");
  return fieldNames(names);
}

const Title*
unclearTitle(const std::vector<Title>& titles, Delimiter delimiter, std::size_t columns)
{
  const auto may_name = [&](const Title& title) {
    if (title.mark.empty())
      return true;
    if (columns <= 3)
      return false;
    if (wordsOf(title, delimiter, columns).size() == columns)
      return true;
    try {
      return !namesIn(title, delimiter, columns).empty();
    }
    catch (const std::runtime_error&) {
      return false;
    }
  };
  const auto title = std::find_if(titles.rbegin(), titles.rend(), may_name);
  return title == titles.rend() ? nullptr : &*title;
}

bool
isFirstRow(std::string_view line,
           const std::vector<Title>& titles,
           std::optional<Delimiter>& delimiter)
{
  for (auto title = titles.rbegin(); title != titles.rend(); ++title)
    for (const auto candidate : DELIMITERS)
      if (isRowBelow(*title, line, candidate)) {
        delimiter = candidate;
        return true;
      }
  for (const auto candidate :
       {Delimiter::TAB, Delimiter::COMMA, Delimiter::SEMICOLON}) {
    std::vector<std::string_view> cells;
    splitColumns(line, candidate, cells);
    if (numberColumns(Words(cells.begin(), cells.end())))
      return false;
  }
  // What starts with a digit is no title where numbers follow.
  std::string spaced(line);
  std::replace_if(
      spaced.begin(), spaced.end(),
      [](char c) { return std::string_view(",;\"").find(c) != std::string_view::npos; },
      ' ');
  std::vector<std::string_view> words;
  splitColumns(spaced, Delimiter::WHITE, words);
  return !words.empty() && (isNumber(words[0]) ||
                            (std::string_view("+-.0123456789").find(words[0][0]) < 13 &&
                             std::any_of(words.begin(), words.end(), isNumber)) ||
                            isNamedPoint(line));
}

} // namespace tool
