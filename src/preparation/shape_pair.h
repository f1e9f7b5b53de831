/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/settings.h>

#include "geometry/nearest_points.h"
#include "geometry/oriented_points.h"
#include "geometry/pose_metric.h"
#include "geometry/pre_shape.h"
#include "geometry/scale_range.h"
#include "preparation/determinacy.h"
#include "preparation/preparation.h"

#include <memory>
#include <optional>

namespace pcl {
namespace kss {

/** \brief A cloud in pre-shape space. */
struct Shape {
  /** \brief Simplified, for the search. */
  PreShape simplified;
  /** \brief As it is, clean, no larger than needed, for refinement and judgement. */
  std::shared_ptr<const NearestPoints> all;
  /** \brief The same with normals, which tell right poses from wrong ones. */
  OrientedPoints surface;
  /** \brief What tells whether it determines a pose, in the units of the cloud. */
  CloudSize extent;
};

/** \brief The two clouds in pre-shape space: what poses are searched for, refined and
 * judged by. */
struct ShapePair {
  Shape source, target;
  /** \brief Tells which poses are the same. */
  PoseMetric metric;
  /** \brief What the scale of a pose between the two is bound to. */
  ScaleRange scales;
  /** \brief What its rotation is about. */
  RotationAxis axis;
  /** \brief Whether heavy noise has been averaged away, which leaves shallow minima
   * beside the right one. */
  bool is_noisy;
};

/** \brief Simplify two clouds and map them to pre-shape space, (e2) of the paper.
 * \param[in] clouds prepared
 * \param[in] guessed_scale the scale of all poses where the settings do not have it
 * estimated; none: 1
 * \param[in] settings simplification, scales and threads
 * \param[in] before a pair of which is kept what stays the same; null: none
 * \throws std::invalid_argument where a cloud determines no pose, or the two do not at
 * the guessed scale, nor at the one that comes nearest to making them equally large
 */
std::shared_ptr<const ShapePair>
shapePair(const PreparedPair& clouds,
          const std::optional<double>& guessed_scale,
          const Settings& settings,
          const ShapePair* before);

} // namespace kss
} // namespace pcl
