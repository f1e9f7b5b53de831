/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <string_view>
#include <vector>

namespace tool {

/** \brief What separates the columns of a text. */
enum class Delimiter {
  WHITE, ///< any white space, as much as there is
  TAB,   ///< each tab; there may be spaces and nothing in between
  COMMA,
  SEMICOLON
};

/** \brief Split a line into its columns, without the quotes around them.
 * \param[in] words takes the columns
 */
void
splitColumns(std::string_view line,
             Delimiter delimiter,
             std::vector<std::string_view>& words);

/** \brief How the rows of a text are written, as the first of them tells. */
class RowFormat {
public:
  explicit RowFormat(std::string_view first_row);

  RowFormat(std::string_view first_row, Delimiter delimiter);

  Delimiter
  delimiter() const
  {
    return delimiter_;
  }

  /** \brief Read a number with the decimal sign that all others have, too; what says
   * that there is none (NaN, NA, null, an empty column) is no number either.
   * \return false where it is something else
   */
  bool
  parse(std::string_view word, double& number);

private:
  enum class Decimal { POINT, COMMA, OPEN };

  Delimiter delimiter_;
  /** \brief Known once a number has one. */
  Decimal decimal_;
};

} // namespace tool
