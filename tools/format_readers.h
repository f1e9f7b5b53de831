/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "geometry.h"

#include <string>

/** \file
 * One reader for each file format. They throw a std::runtime_error that says what is
 * wrong with the file, but not which file it is.
 */

namespace tool {

/** \brief Read a PCD file. */
Geometry
readPCD(const std::string& path);

/** \brief Read a PLY file. */
Geometry
readPLY(const std::string& path);

/** \brief Read an OFF file. */
Geometry
readOFF(const std::string& path);

/** \brief Read an OBJ or STL file. */
Geometry
readWithAssimp(const std::string& path);

/** \brief Read a file of columns: x, y, z and whatever follows. */
Geometry
readText(const std::string& path);

} // namespace tool
