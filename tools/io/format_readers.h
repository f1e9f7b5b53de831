/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "file_format.h"
#include "geometry.h"

#include <istream>

/** \file
 * One reader for each file format. They throw a std::runtime_error that says what is
 * wrong with the file, but not which file it is. What they need of memory follows from
 * the file's size, and not from what its header says.
 */

namespace tool {

/** \brief Read a PCD file. */
Geometry
readPCD(std::istream& stream);

/** \brief Read a PLY file. */
Geometry
readPLY(std::istream& stream);

/** \brief Read an OFF file. */
Geometry
readOFF(std::istream& stream);

/** \brief Read an OBJ file. */
Geometry
readOBJ(std::istream& stream);

/** \brief Read an STL file, binary or text. */
Geometry
readSTL(std::istream& stream);

/** \brief Read a file of columns: x, y, z and others, in the order of their names where
 * it names them.
 * \param[in] format one of those that consist of columns
 */
Geometry
readText(std::istream& stream, FileFormat format);

/** \brief Read a PTX file: the points of all its scans in one frame. */
Geometry
readPTX(std::istream& stream);

} // namespace tool
