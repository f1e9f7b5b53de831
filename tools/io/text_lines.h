/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <istream>
#include <string>
#include <string_view>
#include <vector>

namespace tool {

/** \brief The text before its comment, which starts with a # at the start or behind
 * white space.
 */
std::string_view
withoutComment(std::string_view text);

/** \brief Goes through a text file line by line and reads lines as rows of numbers.
 *
 * The point is the decimal separator whatever the locale. Blank lines are skipped.
 * Lines end as the first one does: with a line feed, or with a carriage return alone.
 */
class TextLines {
public:
  enum class Style {
    COMMENTED, ///< words stand apart by white space; what follows a # is skipped
    RAW,       ///< words stand apart by white space, and there are no comments
    COLUMNS,   ///< as RAW, but tabs at the ends of a line stay: columns may be empty
    STRICT     ///< as RAW, but there must be no byte order mark
  };

  /** \param[in] stream must outlive this object */
  explicit TextLines(std::istream& stream, Style style);

  /** \brief Go to the next line.
   * \return false at the end of the file
   * \throws std::runtime_error where a line is longer than any sensible one
   */
  bool
  next();

  /** \brief Put the next line in the place of this one's last character. */
  void
  join();

  /** \brief The number of the line in the file, from 1. */
  std::size_t
  number() const
  {
    return line_number_;
  }

  /** \brief The line without comments and surrounding white space; empty where there
   * is nothing else. */
  const std::string&
  text() const;

  /** \brief Take the first word off the line. */
  std::string
  takeWord();

  /** \brief Put a word back before the line. */
  void
  putBack(const std::string& word);

  /** \brief Whether the line starts with a number, or with what should be one. */
  bool
  startsWithNumber() const;

  /** \brief What stands in the line apart. */
  const std::vector<std::string_view>&
  words();

  /** \brief The line's numbers.
   * \param[in] first how many words come before them
   * \throws std::runtime_error where something else stands, or a number that single
   * precision cannot hold
   */
  const std::vector<double>&
  numbers(std::size_t first = 0);

  /** \brief Throw a std::runtime_error that names the line and a word. */
  [[noreturn]] void
  failAt(std::string_view word, const std::string& problem) const;

  /** \brief Throw a std::runtime_error that names the line. */
  [[noreturn]] void
  fail(const std::string& problem) const;

private:
  /** \brief Read the next line, whatever it holds. \return false at the end */
  bool
  readLine();

  std::istream& stream_;
  Style style_;
  char end_of_line_;
  std::size_t line_number_ = 0;
  std::string line_, text_;
  std::vector<std::string_view> words_;
  std::vector<double> numbers_;
};

} // namespace tool
