/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <string>
#include <vector>

namespace tool {

/** \brief The names of columns, or of properties, as fields are named: x, y, z,
 * normal_x, normal_y, normal_z, red, green and blue whatever programs call them (X,
 * "x [m]", Points:0, Easting, Nx, NormalX, R), and all others nearly as they are.
 *
 * No two are the same, and none is empty or has white space.
 * \return nothing where no three columns are x, y and z
 * \throws std::runtime_error where only some of x, y and z are there
 */
std::vector<std::string>
fieldNames(const std::vector<std::string>& titles);

} // namespace tool
