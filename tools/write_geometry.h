/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "file_format.h"
#include "geometry.h"

#include <string>

namespace tool {

/** \brief Write a point cloud or mesh.
 *
 * PCD and PLY hold all fields, text all fields in columns, OBJ and OFF positions,
 * normals and colours, STL triangles. PLY, OBJ, OFF and STL hold faces. \param[in] path
 * where to write, whatever its extension \throws std::runtime_error where it cannot be
 * written; the message does not name it
 */
void
writeGeometry(const Geometry& geometry, FileFormat format, const std::string& path);

} // namespace tool
