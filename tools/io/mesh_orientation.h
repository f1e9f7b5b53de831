/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "geometry.h"

#include <vector>

namespace tool {

/** \brief Wind the faces of a mesh such that their normals point out of what it
 * encloses.
 *
 * Faces hang together where exactly two share an edge; points with the same coordinates
 * are one. What is closed, every edge shared by two faces, and can be wound
 * consistently, is: as the file has it where that is consistent, so that a cavity stays
 * one, and else such that its volume is positive. Where those that the file has wound
 * enclose less than nothing, they are turned inside out. All other faces stay.
 */
void
turnOutwards(Geometry& mesh);

/** \brief Which faces turnOutwards() winds the other way round.
 * \param[in] points the positions of the mesh
 */
std::vector<bool>
facesTurnedInwards(const Geometry& mesh, const Points& points);

} // namespace tool
