/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "text_header.h"

#include "column_names.h"
#include "numbers.h"

#include <algorithm>
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

/** The words of a title, without units that spaces set apart: x [m] y [m] z [m]. */
Words
wordsOf(const Title& title, Delimiter delimiter)
{
  std::vector<std::string_view> found;
  splitColumns(title.text, delimiter, found);
  if (!found.empty() && found.back().empty()) // a delimiter may stand at the end
    found.pop_back();
  Words words(found.begin(), found.end());
  if (delimiter == Delimiter::WHITE)
    words.erase(std::remove_if(words.begin(), words.end(), isUnit), words.end());
  return words;
}

/** The names of all columns, from words for all of them or for the first ones. */
Words
namesOf(Words words, const Title& title, Delimiter delimiter, std::size_t columns)
{
  // a word before the names: "columns: x y z"
  if (words.size() == columns + 1 && !words[0].empty() && words[0].back() == ':')
    words.erase(words.begin());
  if (words.size() < 3 || words.size() > columns || columns > MOST_COLUMNS)
    return {};
  if (words.size() == columns)
    return fieldNames(words);
  if (delimiter != Delimiter::WHITE)
    return {};
  // R does not name the column of the names of rows
  if (words.size() + 1 == columns && title.text.find('"') != std::string::npos) {
    words.insert(words.begin(), "row");
    return fieldNames(words);
  }
  while (words.size() < columns)
    words.push_back("column_" + std::to_string(words.size() + 1));
  const Words names = fieldNames(words);
  const bool starts_with_position =
      !names.empty() && names[0] == "x" && names[1] == "y" && names[2] == "z";
  return starts_with_position ? names : Words();
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
  const Words titles = wordsOf(title, delimiter);
  if (titles.size() < 3 || titles.size() > MOST_COLUMNS ||
      titles.size() != words.size())
    return false;
  try {
    const Words names = fieldNames(titles);
    for (std::size_t i = 0; i < names.size(); ++i)
      if ((names[i] == "x" || names[i] == "y" || names[i] == "z") &&
          (words[i].empty() || !format.parse(words[i], ignored)))
        return false;
    return !names.empty();
  }
  catch (const std::runtime_error&) {
    return false;
  }
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
  std::vector<Delimiter> delimiters{delimiter};
  delimiters.insert(delimiters.end(), std::begin(DELIMITERS), std::end(DELIMITERS));
  std::string problem;
  for (auto title = titles.rbegin(); title != titles.rend(); ++title)
    for (const auto candidate : delimiters)
      try {
        const Words names =
            namesOf(wordsOf(*title, candidate), *title, candidate, columns);
        if (!names.empty())
          return TextHeader{names, title->mark};
      }
      catch (const std::runtime_error& error) {
        if (title->mark.empty())
          problem = "line " + std::to_string(title->line) + ": " + error.what();
      }
  if (!problem.empty())
    throw std::runtime_error(problem);
  return std::nullopt;
}

const Title*
unclearTitle(const std::vector<Title>& titles, Delimiter delimiter, std::size_t columns)
{
  for (auto title = titles.rbegin(); title != titles.rend(); ++title)
    if (title->mark.empty() ||
        (columns > 3 && wordsOf(*title, delimiter).size() == columns))
      return &*title;
  return nullptr;
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
                             std::any_of(words.begin(), words.end(), isNumber)));
}

} // namespace tool
