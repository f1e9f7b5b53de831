/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "text_rows.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tool {

/** \brief A line above the rows of a text. */
struct Title {
  std::size_t line;
  /** \brief What marks it as a comment; empty where nothing does. */
  std::string mark;
  /** \brief What stands behind the mark. */
  std::string text;
};

/** \brief What marks a line as a comment: //, #, % or !; empty for others. */
std::string
commentMark(std::string_view line);

/** \brief The columns of a text, by the titles above them. */
struct TextHeader {
  /** \brief As fieldNames() gives them; there may be more columns. */
  std::vector<std::string> names;
  /** \brief What marks the line of the names as a comment, if anything. */
  std::string mark;
  std::size_t line;
  /** \brief Whether the names may be those of the first columns alone. */
  bool is_start_of_row;
};

/** \brief Find the title that names the columns, or, where none has as many names,
 * the last one that names others.
 * \param[in] delimiter of the rows; titles may have another one
 * \param[in] columns how many the rows have
 * \return nothing where no title names x, y and z
 * \throws std::runtime_error where one names only some of them
 */
std::optional<TextHeader>
headerOf(const std::vector<Title>& titles, Delimiter delimiter, std::size_t columns);

/** \brief Whether a title names all columns, and x, y and z among them. */
bool
namesAll(const std::vector<Title>& titles, Delimiter delimiter, std::size_t columns);

/** \brief Names of columns, and before them one for that of the numbers of rows. */
std::vector<std::string>
namesBehindRow(std::vector<std::string> names);

/** \brief A title that may have been meant to name the columns, where none does; null
 * where there is none such.
 */
const Title*
unclearTitle(const std::vector<Title>& titles,
             Delimiter delimiter,
             std::size_t columns);

/** \brief Whether a line is the first of the rows, and not another title.
 * \param[in] titles those before it
 * \param[out] delimiter of the rows, where a title tells
 */
bool
isFirstRow(std::string_view line,
           const std::vector<Title>& titles,
           std::optional<Delimiter>& delimiter);

} // namespace tool
