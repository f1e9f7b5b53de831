/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/scan_work.h>

#include "multiview/candidates_of_pairs.h"

#include <cstddef>
#include <vector>

namespace pcl {
namespace kss {

/** \brief Scans that are placed in a common frame. */
using PlacedGroup = std::vector<std::size_t>;

/** \brief Which scans belong together, and where they are. */
struct Consensus {
  /** \brief The numbers of the scans of each group, rising. */
  std::vector<PlacedGroup> groups;
  /** \brief Of each scan, to a frame of its group. */
  std::vector<StoredPose> poses;
};

/** \brief Candidates agree where they place a scan less far apart than this share of
 * its root mean square radius. */
constexpr double agreeing_share = 0.1;

/** \brief Unite scans by the poses that most pairs agree on.
 *
 * Groups are united two by two, those first whose alignment is most probable. What
 * speaks for one are the pairs between the two groups, and the ways by a third one,
 * that agree with it: each of them closes a loop, and a wrong pose would have to be
 * wrong in the same way, by chance. Against it speak other alignments, as much as they
 * have for them.
 * \param[in] scans descriptions; of those that cannot be used, empty ones
 * \param[in] candidates of all pairs
 */
Consensus
consensusOf(const std::vector<ScanDescription>& scans,
            const std::vector<PoseCandidate>& candidates);

} // namespace kss
} // namespace pcl
