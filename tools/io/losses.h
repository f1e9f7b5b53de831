/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "file_format.h"
#include "geometry.h"

#include <string>
#include <vector>

namespace tool {

/** \brief What of a file's content is lost where it is written in a format, in words
 * for the user: what was not read, and what the format has no room for.
 */
std::vector<std::string>
lossesOf(const Geometry& geometry, FileFormat format);

} // namespace tool
