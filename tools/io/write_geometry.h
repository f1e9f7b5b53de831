/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "file_format.h"
#include "geometry.h"

#include <ostream>

namespace tool {

/** \brief Write a point cloud or mesh.
 *
 * PCD and PLY hold all fields, text all fields in columns, OBJ and OFF positions,
 * normals and colours, PTS and PTX positions, intensities and colours, STL triangles.
 * PLY, OBJ, OFF and STL hold faces. What is lost, lossesOf() tells.
 * \param[in] stream whether it took all is to be seen from its state
 */
void
writeGeometry(const Geometry& geometry, FileFormat format, std::ostream& stream);

} // namespace tool
