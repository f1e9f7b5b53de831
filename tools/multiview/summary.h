/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "model.h"

#include <string>
#include <vector>

namespace tool {

/** \brief The result in a few lines for people at a terminal.
 * \param[in] names of the scans, see scanNames()
 * \param[in] folder that has the files
 */
std::string
modelSummary(const Model& model,
             const std::vector<std::string>& names,
             const std::string& folder);

} // namespace tool
