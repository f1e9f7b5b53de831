/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "multiview/placed_scans.h"

#include <cstddef>
#include <vector>

namespace pcl {
namespace kss {

/** \brief By how much the odds of pairs are less than they say by themselves, as a
 * logarithm. Confidences were fitted on pairs most of which fit; of many scans each
 * fits a few others: the more pairs are tried for each, the fewer of them are right.
 * \param[in] pairs how many were tried, and have a pose
 * \param[in] scans how many there are
 */
double
shiftOfMany(std::size_t pairs, std::size_t scans);

/** \brief Find groups, and poses in them, by what pairs say. Where pairs of a scan that
 * are sure by themselves turn out to disagree, as those of rooms that are built alike,
 * all pairs of that scan are believed less.
 * \param[in] pairs what registrations have come to
 * \param[in] shifts of the logarithm of the odds of each pair: see shiftOfMany()
 * \param[in,out] placed gets groups and poses
 */
void
placeByPairs(const std::vector<PairResult>& pairs,
             const std::vector<double>& shifts,
             PlacedScans& placed);

} // namespace kss
} // namespace pcl
