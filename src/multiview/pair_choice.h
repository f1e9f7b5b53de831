/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/scan_work.h>

#include <cstddef>
#include <utility>
#include <vector>

namespace pcl {
namespace kss {

/** \brief Two scans, the lower number first. */
using ScanPair = std::pair<std::size_t, std::size_t>;

/** \brief The pairs of scans in the order in which they are worth a try: all of them,
 * where there are few scans; otherwise, of each scan, those that resemble it most and
 * those next to it in the order given, as scanners go on from where they are.
 * \param[in] scans descriptions
 * \param[in] usable the numbers of those that can be used
 * \param[in] all_pairs up to so many scans, all pairs
 * \param[in] partners otherwise so many of each
 */
std::vector<ScanPair>
pairsToTry(const std::vector<ScanDescription>& scans,
           const std::vector<std::size_t>& usable,
           std::size_t all_pairs,
           std::size_t partners);

/** \brief How much two scans resemble each other, by their features: the higher the
 * more. */
double
resemblance(const ScanDescription& a, const ScanDescription& b);

} // namespace kss
} // namespace pcl
