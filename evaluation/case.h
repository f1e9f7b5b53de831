/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "method.h"
#include "protocol.h"
#include "surface.h"

#include <Eigen/StdVector>

#include <string>
#include <vector>

namespace evaluation {

using Normals = std::vector<Eigen::Vector3f>;

/** \brief Two clouds of one model, and how the one lies to the other. */
struct Case {
  Cloud::Ptr source, target;
  /** The surface's own normals at the points, noise or not. */
  Normals source_normals, target_normals;
  /** The similarity that maps the source to the target. */
  Eigen::Matrix4d truth = Eigen::Matrix4d::Identity();
  double diagonal = 1.0; ///< the target's
  double overlap = 1.0;  ///< the share of the target that the source shows
  unsigned int seed = 0; ///< for methods that draw
  /** Two samplings of the whole model, free of noise, placed as the target is. */
  Cloud::Ptr whole, whole_again;
};

/** \brief Make a case; it follows from the names and the seed alone.
 *
 * The target is a sampling of the model as it is. The source is another one that takes,
 * in this order, what the condition says: a changed density, noise along the normals,
 * (e_noise) of the paper, a part cut off by a plane; and then a similarity.
 */
Case
makeCase(const Surface& surface,
         const std::string& model,
         const Condition& condition,
         unsigned int repetition,
         const Protocol& protocol);

/** \brief The case as those methods get it that cannot estimate scale: the source has
 * been scaled by the true scale.
 */
Case
withTrueScale(const Case& original);

/** \brief The scale of a similarity. */
double
scaleOf(const Eigen::Matrix4d& similarity);

} // namespace evaluation
