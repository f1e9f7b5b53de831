/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/detail/points.h>
#include <pcl/registration/kss/evidence.h>
#include <pcl/registration/kss/export.h>
#include <pcl/registration/kss/settings.h>

#include <cstddef>
#include <string>
#include <vector>

namespace pcl {
namespace kss {

/** \brief How much of two clouds lies on each other at a pose. */
struct Overlap {
  /** \brief The share of the source that the target covers, in [0, 1]. */
  double source = 0.0;
  /** \brief The share of the target that the source covers, in [0, 1]. */
  double target = 0.0;
  /** \brief How closely: the sum over both clouds of the mean of max(0, 1 - d^2 / h^2),
   * d being the distance of a point to the other cloud and h the spacing of the points
   * there. In [0, 2]; two samplings of one surface come to 1.5, whatever the shape, the
   * density or the noise, less the missing parts.
   */
  double score = 0.0;
};

/** \brief A pose that competes to be the result. */
struct Alternative {
  /** \brief The similarity that maps the source onto the target. */
  StoredPose transformation;
  /** \brief How much of the clouds lies on each other there. */
  Overlap overlap;
  /** \brief What the surfaces of the clouds say of it. */
  Evidence evidence = {};
};

/** \brief Poses, the best first. */
using Alternatives = std::vector<Alternative>;

/** \brief How many points of two clouds are too far away from the others to be held. */
struct FarPoints {
  std::size_t source = 0; ///< of the source
  std::size_t target = 0; ///< of the target
};

/** \brief The logarithm of the odds that a pose is right, from what the surfaces say of
 * it: fitted, see docs/confidence.md.
 */
PCL_KSS_ICP_EXPORT double
logOddsOf(const Alternative& alternative);

/** \brief The probability that two clouds show one object, and that the first of the
 * poses, or one about as good, is right: from its odds and how far ahead of the next
 * distinct pose it is; no closer to 1 than the number of points that are explained
 * allows. 0 where there is no pose.
 */
PCL_KSS_ICP_EXPORT double
confidenceOf(const Alternatives& alternatives);

/** \brief Whether chance alone can account for the difference between what the surfaces
 * say of two poses. */
PCL_KSS_ICP_EXPORT bool
areEquallyGood(const Alternative& a, const Alternative& b);

/** \brief Whether the second of the alternatives is about as good as the first, and the
 * first one rather sure than not: without a pose there is no choice of poses. */
PCL_KSS_ICP_EXPORT bool
isAmbiguous(const Alternatives& alternatives);

/** \brief The mode that an overlap speaks for: complete is what lies on the other cloud
 * almost entirely. */
PCL_KSS_ICP_EXPORT Mode
modeOf(const Overlap& overlap);

/** \brief One sentence on clouds that do not fit at the best pose. */
PCL_KSS_ICP_EXPORT std::string
misfitAt(const Evidence& evidence);

} // namespace kss
} // namespace pcl
