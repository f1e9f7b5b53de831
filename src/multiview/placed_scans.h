/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/scan_work.h>

#include "multiview/consensus.h"
#include "multiview/placement_of_scans.h"

#include <cstddef>
#include <limits>
#include <vector>

namespace pcl {
namespace kss {

/** \brief The pose of a pair that is nearest to where its scans have been placed. */
struct NearestPose {
  std::size_t pose = 0;
  /** \brief How far away it is, see displacement(). */
  double deviation = std::numeric_limits<double>::infinity();
};

/** \brief Scans, and where they are as far as that is known. */
struct PlacedScans {
  /** \brief What they are like; empty ones of those that cannot be used. */
  std::vector<ScanDescription> descriptions;
  /** \brief The numbers of the scans of each group, rising. */
  std::vector<PlacedGroup> groups;
  /** \brief Of each scan, to a frame of its group. */
  std::vector<StoredPose> poses;

  /** \brief Where the source is in the frame of the target, of one group both. */
  Eigen::Matrix4d
  relativePose(std::size_t source, std::size_t target) const;

  /** \brief How far a pose of a pair places the source from where it is. */
  double
  deviationOf(std::size_t source, std::size_t target, const StoredPose& pose) const;

  /** \brief How much of two scans of a group lies on each other. */
  ExpectedOverlap
  overlapOf(std::size_t source, std::size_t target) const;

  NearestPose
  nearestPose(const PairResult& pair) const;

  /** \brief Whether a pose of a pair, both of whose scans are in one group, is where
   * they are. */
  bool
  isKept(const PairResult& pair) const;

  double
  smallerRadius(std::size_t a, std::size_t b) const;

  /** \brief The scans of a group where they are. */
  std::vector<PlacedScan>
  members(const PlacedGroup& group) const;
};

} // namespace kss
} // namespace pcl
