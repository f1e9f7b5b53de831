/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "model.h"

#include <string>
#include <vector>

namespace tool {

/** \brief The graph of pairs as SVG: kept and rejected pairs, and the refused ones that
 * are not out of the question.
 * \param[in] names of the scans
 */
std::string
drawGraph(const Model& model, const std::vector<std::string>& names);

/** \brief How many pairs of which verdict have which confidence, as SVG. */
std::string
drawConfidences(const pcl::kss::Multiview& result);

} // namespace tool
