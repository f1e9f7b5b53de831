/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "io/geometry.h"

#include <pcl/registration/kss/multiview.h>

#include <Eigen/Core>

#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace tool {

/** \brief Many scans in common frames, and all that files about them need.
 *
 * People and files count scans and groups from 1.
 */
struct Model {
  /** \brief In the coordinates of the files. */
  pcl::kss::Multiview result;
  /** \brief The paths of the scans. */
  std::vector<std::string> files;
  /** \brief Reads a scan again, by its number from 0; throws where it cannot. */
  std::function<Geometry(std::size_t)> read;
  /** \brief So many points stand for a mesh. */
  std::size_t samples = 10000;
  /** \brief The edge of the cubes of which merged clouds have one point each; 0: they
   * have all points. */
  double spacing = 0.0;
  /** \brief The program, with its version. */
  std::string maker;
  /** \brief Names and values of what was set, for people. */
  std::vector<std::pair<std::string, std::string>> settings;
  /** \brief How many pieces of work were done of which kind. */
  std::vector<std::pair<std::string, std::size_t>> tasks;
  /** \brief Wall time of all of it. */
  double seconds = 0.0;
};

/** \brief How many there are of what. */
struct ModelCounts {
  std::size_t scans = 0;
  std::size_t groups = 0;  ///< of two scans or more
  std::size_t grouped = 0; ///< scans in these
  std::size_t alone = 0;   ///< scans that nothing connects
  std::size_t unusable = 0;
  std::size_t kept = 0, rejected = 0, refused = 0, failed = 0; ///< pairs
};

ModelCounts
countsOf(const pcl::kss::Multiview& result);

/** \brief Whether a scan could be used. */
bool
isUsable(const pcl::kss::ScanPose& scan);

/** \brief The groups of two scans or more, which come first. */
std::vector<std::vector<std::size_t>>
connectedGroups(const pcl::kss::Multiview& result);

/** \brief Names of scans that are short, legal as names of files, and unique: those of
 * the files without ending; where they collide, with that of the folder; where these
 * do, too, with the number.
 */
std::vector<std::string>
scanNames(const std::vector<std::string>& files);

/** \brief The pose of a pair that its numbers are of: the one that the model goes by,
 * or the likeliest one; null where there is none. */
const pcl::kss::PairPose*
poseOf(const pcl::kss::GraphPair& pair);

/** \brief The word for a verdict: "kept". */
const char*
wordOf(pcl::kss::PairVerdict verdict);

/** \brief Which groups fit each other at another scale, each in a sentence.
 * \param[in] names of the scans
 */
std::vector<std::string>
linksInWords(const pcl::kss::Multiview& result, const std::vector<std::string>& names);

/** \brief The answer in one line: "40 scans: one group", "13 scans in 4 groups", "9
 * scans: 6 in 2 groups, 3 alone". */
std::string
headlineOf(const pcl::kss::Multiview& result);

} // namespace tool
