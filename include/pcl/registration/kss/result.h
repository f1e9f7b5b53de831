/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/detail/points.h>
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
};

/** \brief Poses by falling score of their overlap. */
using Alternatives = std::vector<Alternative>;

/** \brief How many points of two clouds are too far away from the others to be held. */
struct FarPoints {
  std::size_t source = 0; ///< of the source
  std::size_t target = 0; ///< of the target
};

/** \brief How sure it is that two clouds show one object at a pose, in [0, 1]: the
 * logistic function of the overlap's score.
 *
 * The best poses of different objects score up to 0.43, of smooth lumps up to 0.53;
 * right ones 0.57 and more, which is two fifths of each cloud lying on the other;
 * between them, at 0.55, the confidence is 0.5.
 */
PCL_KSS_ICP_EXPORT double
confidenceOf(const Overlap& overlap);

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
misfitAt(const Overlap& overlap);

} // namespace kss
} // namespace pcl
