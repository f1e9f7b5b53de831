/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <string>

namespace benchmarks {

/** \brief Write pairs for other programs into a folder, which is made: for each pair
 * NAME a NAME_source.pcd, a NAME_target.pcd, and a NAME_truth.txt, the matrix that maps
 * the source to the target.
 * \return whether all of them are there
 */
bool
writeClouds(const std::string& folder);

} // namespace benchmarks
