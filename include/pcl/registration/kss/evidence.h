/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

namespace pcl {
namespace kss {

/** \brief What one cloud says of a pose at which the other is laid on it. */
struct Support {
  /** \brief The share of its points that are near the other cloud, in [0, 1]. */
  double near = 0.0;
  /** \brief The share of its points that surfaces of the other explain: near, within
   * the noise, with a normal that agrees. */
  double explained = 0.0;
  /** \brief The share of what all of its points say about the pose that the explained
   * ones say, in the direction of motion in which that is least. */
  double worst = 0.0;
  /** \brief The same among the points that are near the other cloud: what has no
   * counterpart does not count, what contradicts does. */
  double consistent = 0.0;
  /** \brief Number of points that are explained. */
  double points = 0.0;
};

/** \brief How much of what two clouds say about a pose speaks for it. */
struct Evidence {
  Support source; ///< of the source's points, by the target's surfaces
  Support target; ///< of the target's points, by the source's surfaces
  /** \brief How far explained points lie off the other cloud's planes, root mean
   * square, as a multiple of the noise of both. */
  double residual = 0.0;
  /** \brief The noise, as a multiple of the spacing of the points. */
  double noise = 0.0;
  /** \brief How far off an explained point may be, as a multiple of the smaller cloud's
   * root mean square radius. */
  double reach = 0.0;
  /** \brief How large the source is where the pose has placed it, as a multiple of the
   * target: root mean square radii. */
  double size = 1.0;
};

} // namespace kss
} // namespace pcl
