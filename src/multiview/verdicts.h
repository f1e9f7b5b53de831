/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "multiview/placed_scans.h"

#include <vector>

namespace pcl {
namespace kss {

/** \brief What pairs are to the model that they have led to.
 * \param[in] pairs by source, then target
 * \param[in] placed where the scans are
 */
std::vector<GraphPair>
verdictsOn(const std::vector<PairResult>& pairs, const PlacedScans& placed);

} // namespace kss
} // namespace pcl
