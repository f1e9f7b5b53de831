/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "geometry.h"

namespace tool {

/** \brief Spread points over the faces of a mesh, uniformly by area and the same ones
 * at every call. \param[in] number of points \return the points; those of the mesh
 * itself where its faces have no area
 */
Points
sampleMesh(const Geometry& mesh, std::size_t number);

} // namespace tool
