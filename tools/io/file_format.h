/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <istream>
#include <string>

namespace tool {

/** \brief The formats of point cloud and mesh files. */
enum class FileFormat {
  PCD,
  PLY,
  OBJ,
  STL,
  OFF,
  TEXT, ///< columns of numbers, of any ending
  CSV,  ///< columns with commas between them, and their names above
  PTS,  ///< columns with their number above: x y z, intensity, red green blue
  PTX   ///< scans with their places
};

/** \brief The format of a file by its extension, in lower or upper case.
 * \throws std::runtime_error naming the file where the extension is unknown
 */
FileFormat
fileFormatOf(const std::string& path);

/** \brief The format of a file that is there: by how it starts where that tells, else
 * by its extension, else text.
 * \param[in] stream at its beginning, where it is left
 * \throws std::runtime_error where it is of another format
 */
FileFormat
fileFormatOf(const std::string& path, std::istream& stream);

/** \brief The format of a file that is to be written: by its extension, or, where that
 * is unknown, that of the file it is made of if both have the same extension.
 * \throws std::runtime_error naming the file where neither tells
 */
FileFormat
fileFormatLike(const std::string& path, const std::string& source);

} // namespace tool
