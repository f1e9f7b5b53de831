/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "file_format.h"
#include "geometry.h"

#include <ostream>

/** \file
 * One writer for each file format.
 */

namespace tool {

/** \brief Write a PCD file with all fields, binary unless they were read otherwise. */
void
writePCD(std::ostream& stream, const Geometry& geometry);

/** \brief Write a PLY file with all fields and faces, binary unless they were read as
 * text. */
void
writePLY(std::ostream& stream, const Geometry& geometry);

/** \brief Write an OBJ file with positions, normals, colours and faces; all statements
 * of what was read as OBJ. */
void
writeOBJ(std::ostream& stream, const Geometry& geometry);

/** \brief Write an OFF file with positions, normals, colours, texture coordinates and
 * faces. */
void
writeOFF(std::ostream& stream, const Geometry& geometry);

/** \brief Write an STL file with the triangles that the faces consist of: binary,
 * unless they were read as text or floats would be too coarse. */
void
writeSTL(std::ostream& stream, const Geometry& geometry);

/** \brief Write all fields as columns, with their names above where readers would not
 * know them; PTS only what all know.
 * \param[in] format one of those that consist of columns
 */
void
writeText(std::ostream& stream, const Geometry& geometry, FileFormat format);

/** \brief Write a PTX file with one scan: positions, intensities and colours. */
void
writePTX(std::ostream& stream, const Geometry& geometry);

} // namespace tool
