/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <istream>
#include <string>
#include <vector>

namespace tool {

/** \brief Goes through a text file line by line and reads lines as rows of numbers.
 *
 * The point is the decimal separator whatever the locale. Blank lines are skipped.
 */
class TextLines {
public:
  enum class Style {
    FREE,  ///< numbers stand apart by white space, or semicolons, or commas; what
           ///< follows a # or starts with // is skipped
    STRICT ///< numbers stand apart by white space, and nothing else is in the file
  };

  /** \param[in] stream must outlive this object
   * \param[in] lines_before how many lines of the file were read before
   */
  explicit TextLines(std::istream& stream,
                     Style style = Style::FREE,
                     std::size_t lines_before = 0);

  /** \brief Go to the next line. \return false at the end of the file */
  bool
  next();

  /** \brief The line without comments and surrounding white space. */
  const std::string&
  text() const;

  /** \brief Take the first word off the line. */
  std::string
  takeWord();

  /** \brief Whether the line starts with a number. */
  bool
  startsWithNumber() const;

  /** \brief The line's numbers.
   * \throws std::runtime_error where something else stands
   */
  const std::vector<double>&
  numbers();

  /** \brief Throw a std::runtime_error that names the line. */
  [[noreturn]] void
  fail(const std::string& problem) const;

private:
  /** \brief The characters that separate the numbers of the line. */
  const char*
  separators() const;

  std::istream& stream_;
  Style style_;
  std::size_t line_number_;
  std::string text_;
  std::vector<double> numbers_;
};

/** \brief Check that nothing but rows of numbers follow in a stream: PCL's readers take
 * anything for numbers.
 * \param[in] lines_before how many lines of the file were read before
 * \param[in] columns how many numbers a row has; 0: any
 * \return how many rows there are
 */
std::size_t
countRows(std::istream& stream, std::size_t lines_before, std::size_t columns);

} // namespace tool
