/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "model.h"

#include <string>
#include <vector>

namespace tool {

/** \brief A table of the scans as HTML. */
std::string
scanTable(const Model& model, const std::vector<std::string>& names);

/** \brief Tables of the pairs as HTML, one for each verdict. */
std::string
pairTables(const Model& model, const std::vector<std::string>& names);

/** \brief The likeliest refused or rejected pairs between groups, as HTML; empty where
 * there are none. */
std::string
nearMisses(const Model& model, const std::vector<std::string>& names);

/** \brief The number of a scan in its colour, and its name. */
std::string
scanLabel(std::size_t scan, const std::vector<std::string>& names);

} // namespace tool
