/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "file_format.h"
#include "geometry.h"

#include <map>
#include <string>
#include <vector>

namespace tool {

/** \brief The rows of a text, and what is known of their columns. */
struct TextTable {
  enum class Kind {
    OPEN, ///< no number so far
    NUMBERS,
    WORDS
  };

  std::size_t columns = 0;
  /** \brief As fieldNames() gives them, or none. */
  std::vector<std::string> names;
  /** \brief Whether the file names its columns, and what marks that line. */
  bool has_names = false;
  std::string header_mark;
  /** \brief Where x, y and z start if the file does not name its columns. */
  std::size_t first_position = 0;
  std::vector<Kind> kinds;
  /** \brief What made words of columns of numbers, by their numbers. */
  std::map<std::size_t, std::string> strays;
  /** \brief Of all rows with a point, row by row; of words nothing. */
  std::vector<double> values;
  std::size_t rows_without_point = 0, first_without_point = 0;
  std::vector<std::string> assumed;

  /** \brief Whether a column is x, y or z. */
  bool
  isPosition(std::size_t column) const
  {
    if (!has_names)
      return column >= first_position && column < first_position + 3;
    const auto& name = names[column];
    return name == "x" || name == "y" || name == "z";
  }
};

/** \brief Whether the first column holds the numbers of rows: whole ones, each one more
 * than the one before it.
 */
bool
firstColumnCounts(const TextTable& table);

/** \brief The points of a table.
 *
 * Columns without names that have unit length in every row, three by three, are
 * normals. Whole numbers from 0 to 255 that are named red, green and blue become one
 * colour.
 */
Geometry
toGeometry(TextTable table, FileFormat format);

} // namespace tool
