/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "geometry.h"

#include <string>

namespace tool {

/** \brief Read a point cloud or mesh of a format known by its extension.
 *
 * PCD, PLY, OFF and text keep all digits; OBJ and STL come in single precision.
 * \throws std::runtime_error naming the file where it cannot be read, is incomplete, or
 * has no finite points
 */
Geometry
readGeometry(const std::string& path);

} // namespace tool
