/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "geometry.h"

#include <ostream>

/** \file
 * One writer for each file format.
 */

namespace tool {

/** \brief Write a binary PCD file with all fields. */
void
writePCD(std::ostream& stream, const Geometry& geometry);

/** \brief Write a binary PLY file with all fields and faces. */
void
writePLY(std::ostream& stream, const Geometry& geometry);

/** \brief Write an OBJ file with positions, normals, colours and faces. */
void
writeOBJ(std::ostream& stream, const Geometry& geometry);

/** \brief Write an OFF file with positions, normals, colours and faces. */
void
writeOFF(std::ostream& stream, const Geometry& geometry);

/** \brief Write a binary STL file with the triangles that the faces consist of. */
void
writeSTL(std::ostream& stream, const Geometry& geometry);

/** \brief Write all fields as columns. */
void
writeText(std::ostream& stream, const Geometry& geometry);

} // namespace tool
