/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "geometry.h"

#include <string>

namespace tool {

/** \brief Read a point cloud or mesh of a format known by how it starts, or by its
 * extension.
 *
 * All digits are kept. What the reader took for granted, and what it left out, is told
 * in Geometry::assumed and Geometry::left_out.
 * \throws std::runtime_error naming the file where it cannot be read, is incomplete, or
 * has no finite points
 */
Geometry
readGeometry(const std::string& path);

} // namespace tool
