/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/scan_work.h>

#include "multiview/placed_scans.h"

#include <cstddef>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace pcl {
namespace kss {

/** \brief Two scans, the lower number first. */
using ScanPair = std::pair<std::size_t, std::size_t>;

/** \brief The number of the group of each scan. */
std::vector<std::size_t>
groupOfEach(const std::vector<std::vector<std::size_t>>& groups, std::size_t scans);

/** \brief The pairs of scans in the order in which they are worth a try: all of them,
 * where there are few scans; otherwise, of each scan, those that resemble it most and
 * those next to it in the order given, as scanners go on from where they are.
 * \param[in] resemblances of all scans, where there are more than that
 * \param[in] usable the numbers of those that can be used
 * \param[in] all_pairs up to so many scans, all pairs
 * \param[in] partners otherwise so many of each
 */
std::vector<ScanPair>
pairsToTry(const Eigen::MatrixXf& resemblances,
           const std::vector<std::size_t>& usable,
           std::size_t all_pairs,
           std::size_t partners);

/** \brief The pairs that may yet connect groups: of each group, those with the groups
 * that resemble it most, by what has been tried; some for each.
 * \param[in] resemblances of all scans, where not all pairs have been tried
 * \param[in] usable the numbers of those that can be used
 * \param[in] groups of scans that are connected
 * \param[in] tried what has come of the pairs that have been tried
 * \param[in] thorough those of them that need not be tried again
 * \param[in] partners so many groups for each
 */
std::vector<ScanPair>
wantedPairs(const Eigen::MatrixXf& resemblances,
            const std::vector<std::size_t>& usable,
            const std::vector<std::vector<std::size_t>>& groups,
            const std::map<ScanPair, PairResult>& tried,
            const std::set<ScanPair>& thorough,
            std::size_t partners);

/** \brief Groups that may show the same thing: of each group those that resemble it
 * most, as for wantedPairs(). The lower number of the two is first. */
std::vector<std::pair<std::size_t, std::size_t>>
resemblingGroups(const Eigen::MatrixXf& resemblances,
                 const std::vector<std::size_t>& usable,
                 const std::vector<std::vector<std::size_t>>& groups,
                 const std::map<ScanPair, PairResult>& tried,
                 std::size_t partners);

/** \brief How much two scans resemble each other: how many places of them have the
 * features of each other, and lie as far apart from one of them. */
double
resemblance(const ScanDescription& a, const ScanDescription& b);

/** \brief How much each of some scans resembles each other one; 0 elsewhere.
 * \param[in] threads 0: as many as there are cores */
Eigen::MatrixXf
resemblancesOf(const std::vector<ScanDescription>& scans,
               const std::vector<std::size_t>& usable,
               unsigned int threads);

/** \brief More pairs of scans that hang on few others, where these have been placed so
 * that they overlap: the pairs agree, or speak against that.
 * \param[in] tried what has been tried
 */
std::set<ScanPair>
pairsThatConfirm(const PlacedScans& placed,
                 const std::map<ScanPair, PairResult>& tried);

} // namespace kss
} // namespace pcl
