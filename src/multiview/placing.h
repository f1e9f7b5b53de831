/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "multiview/placed_scans.h"

#include <cstddef>
#include <vector>

namespace pcl {
namespace kss {

/** \brief Find groups, and poses in them, by what pairs say. Where pairs that are sure
 * by themselves turn out to disagree, as those of rooms that are built alike, all are
 * believed less.
 * \param[in] pairs what registrations have come to
 * \param[in] usable how many of the scans can be used
 * \param[in,out] placed gets groups and poses
 */
void
placeByPairs(const std::vector<PairResult>& pairs,
             std::size_t usable,
             PlacedScans& placed);

} // namespace kss
} // namespace pcl
