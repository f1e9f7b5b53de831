/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <string>

namespace tool {

/** \brief The formats of point cloud and mesh files. */
enum class FileFormat { PCD, PLY, OBJ, STL, OFF, TEXT };

/** \brief The format of a file by its extension, in lower or upper case.
 * \throws std::runtime_error naming the file where the extension is unknown
 */
FileFormat
fileFormatOf(const std::string& path);

} // namespace tool
