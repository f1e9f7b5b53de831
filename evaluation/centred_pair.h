/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "method.h"

namespace evaluation {

/** \brief The clouds of a task, each moved so that its centroid is the origin. PCL
 * computes in single precision, which then suffices wherever the clouds lie; and where
 * nothing better is known, centroid on centroid is where to begin.
 */
struct CentredPair {
  explicit CentredPair(const Task& task);

  /** \brief From the source to the target of the task.
   * \param[in] pose from the centred source to the centred target
   */
  Eigen::Matrix4d
  uncentred(const Eigen::Matrix4d& pose) const;

  Cloud::Ptr source{new Cloud}, target{new Cloud};
  Eigen::Vector3d source_centroid, target_centroid;
};

/** \brief The root of the mean squared distance to the origin. */
float
rmsRadiusOf(const Cloud& cloud);

/** \brief The mean distance to the nearest neighbour, by a thousand of the points. */
float
spacingOf(const Cloud::ConstPtr& cloud);

} // namespace evaluation
