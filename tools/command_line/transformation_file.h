/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <Eigen/Core>

#include <string>

namespace tool {

/** \brief The 4x4 numbers of a transformation, a row per line, with all their digits.
 */
std::string
transformationText(const Eigen::Matrix4d& transformation);

/** \brief Read a transformation as \c --transform writes it: 4x4 numbers, row by row.
 * \throws std::runtime_error naming the file where it holds none, or one that is no
 * similarity
 */
Eigen::Matrix4d
readTransformation(const std::string& path);

} // namespace tool
