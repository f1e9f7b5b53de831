/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "case.h"

namespace evaluation {

/** \brief The paper's measures: means over the source's points. */
struct Errors {
  double mse = 0.0;  ///< mean of the squares
  double rmse = 0.0; ///< root of it
  double mae = 0.0;  ///< mean
};

/** \brief How good a pose is. */
struct Metrics {
  /** Distances from the aligned source points to the nearest target points; the
   * target's diagonal is 1. */
  Errors distance;
  /** Angles in radians, in [0, pi/2], between the normals there; whichever side they
   * point to. */
  Errors angle;
  double rotation_degrees = 0.0; ///< between the pose's rotation and the true one
  double translation = 0.0; ///< between where the source's centroid is and should be;
                            ///< the target's diagonal is 1
  double scale = 0.0;       ///< |found / true - 1|
  /** Root mean square distance between where the source's points are and should be; the
   * target's diagonal is 1. */
  double target_registration_error = 0.0;
  /** Less than 5 degrees, 5 % of the diagonal and 5 % of the scale off, or a pose that
   * a symmetric model cannot tell from such a one. */
  bool solved = false;
  /** Whether it is only the symmetry by which it is solved; the pose's errors then say
   * nothing. */
  bool by_symmetry = false;
};

/** \brief Judge a pose that maps the source to the target. */
Metrics
metricsOf(const Case& work, const Eigen::Matrix4d& pose);

} // namespace evaluation
