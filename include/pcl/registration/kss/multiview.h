/*
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * Many scans: from pairs to a pose of each.
 */

#pragma once

#include <pcl/registration/kss/cloud_registration.h>
#include <pcl/registration/kss/detail/points.h>
#include <pcl/registration/kss/export.h>
#include <pcl/registration/kss/failure.h>
#include <pcl/registration/kss/result.h>
#include <pcl/registration/kss/settings.h>
#include <pcl/registration/kss/stages.h>

#include <Eigen/Core>

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace pcl {
namespace kss {

/** \brief What a pair of scans is to the model. */
enum class PairVerdict {
  KEPT,     ///< the model rests on it
  REJECTED, ///< it fits by itself, but loops of other pairs, or what other scans show
            ///< at its pose, speak against it
  REFUSED,  ///< the scans do not fit at any pose that was found
  FAILED    ///< it could not be tried
};

/** \brief A pose of the source of a pair on its target, and how precise it is. */
struct PairPose {
  /** \brief Maps the source onto the target. */
  StoredPose transformation = StoredPose::Identity();
  /** \brief Its information: the inverse of the covariance over the rotation (radians
   * about the axes of the target) and the translation of the source's centroid (unit of
   * the clouds); zero in directions that the surfaces do not determine. */
  Eigen::Matrix<double, 6, 6, Eigen::DontAlign> information =
      Eigen::Matrix<double, 6, 6, Eigen::DontAlign>::Zero();
  /** \brief How much of the scans lies on each other there. */
  Overlap overlap;
  /** \brief What the surfaces say of it, see logOddsOf(). */
  double log_odds = 0.0;
};

/** \brief What the registration of two scans has come to. */
struct PairResult {
  std::size_t source = 0; ///< the number of the scan that is placed
  std::size_t target = 0; ///< the number of the scan that it is placed upon
  /** \brief The distinct poses, the likeliest first; empty where there is none. */
  std::vector<PairPose> poses;
  /** \brief How sure it is that the first pose is right, in [0, 1]. */
  double confidence = 0.0;
  /** \brief Whether the second pose is about as good as the first. */
  bool ambiguous = false;
  /** \brief Whether all scans of the two's groups, as they were then, have been
   * registered with each other instead of the two alone. */
  bool of_groups = false;
  /** \brief Why the first pose cannot be relied on by itself. */
  Failure failure;
};

/** \brief A pair of scans in the graph. */
struct GraphPair {
  /** \brief What its registration has come to. */
  PairResult result;
  /** \brief What it is to the model. */
  PairVerdict verdict = PairVerdict::REFUSED;
  /** \brief Which of its poses the model goes by, where it is kept. */
  std::size_t pose = 0;
  /** \brief How far the model places the source from where the pose does, root mean
   * square over its points, in the unit of the scans; 0 where the two are not in one
   * group. */
  double deviation = 0.0;
  /** \brief Triangles of pairs that agree with it. */
  std::size_t loops = 0;
  /** \brief One sentence on what speaks against it; empty where it is kept. */
  std::string reason;
};

/** \brief Where a scan is. */
struct ScanPose {
  /** \brief Maps the scan to the frame of its group: that of the group's first scan. */
  StoredPose transformation = StoredPose::Identity();
  /** \brief The number of its group. */
  std::size_t group = 0;
  /** \brief The mean of its points, in its own coordinates. */
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
  /** \brief Why it could not be used; FailureCause::NONE: it could. */
  Failure failure;
};

/** \brief What is known of the frames of two groups. */
struct GroupLink {
  std::size_t source = 0; ///< the number of a group
  std::size_t target = 0; ///< the number of another one
  /** \brief The similarity that maps the frame of the source to that of the target. */
  StoredPose transformation = StoredPose::Identity();
  /** \brief How sure it is that this is right, in [0, 1]. */
  double confidence = 0.0;
  /** \brief Whether another one fits about as well. */
  bool ambiguous = false;
};

/** \brief Many scans in common frames. */
struct Multiview {
  /** \brief A pose for each scan, in their order. */
  std::vector<ScanPose> scans;
  /** \brief The numbers of the scans of each group: the largest groups first; those of
   * equal size by their first scan. A scan that nothing connects is a group. */
  std::vector<std::vector<std::size_t>> groups;
  /** \brief All pairs that were tried, by source, then target. */
  std::vector<GraphPair> pairs;
  /** \brief Groups of other units that fit each other, where that was asked for: see
   * MultiviewSettings::scale_between_groups. */
  std::vector<GroupLink> links;
  /** \brief Why there is nothing, or no end; FailureCause::NONE: all is done. */
  Failure failure;
  /** \brief Wall time of the stages. */
  std::vector<StageSeconds> seconds;
};

} // namespace kss
} // namespace pcl
