/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <string>

namespace pcl {
namespace kss {

/** \brief Whether a platform that does not work lacks a folder to keep built programs
 * in, which PoCL cannot do without and does not name.
 * \param[in] platform its name
 * \return a sentence that says so after a space; empty: it has one, or needs none
 */
std::string
kernelCacheProblem(const std::string& platform);

} // namespace kss
} // namespace pcl
