/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/detail/surface_step.h>

#include <Eigen/Core>

namespace pcl {
namespace kss {

/** \brief What a pose may change by: rotation, translation and logarithm of the scale,
 * the first and the last times the radius, so that all have the unit of coordinates. */
using Change = Eigen::Matrix<double, 7, 1>;

/** \brief A matrix over the entries of a \ref Change. */
using ChangeMatrix = Eigen::Matrix<double, 7, 7>;

/** \brief A basis of the changes that settings allow: a column per direction, a row for
 * each of the first entries of a \ref Change, its last one only where the scale is
 * estimated. */
Eigen::MatrixXd
freeChanges(const SurfaceStepSettings& settings, bool with_scale);

/** \brief The pairs that have a say, as linear equations of a change of the pose. */
struct PairEquations {
  /** \brief By what the distances to the planes change, a column per pair. */
  Eigen::Matrix<double, 7, Eigen::Dynamic> columns;
  /** \brief The distances to the planes. */
  Eigen::VectorXd residuals;
  /** \brief The middles of the pairs. */
  Eigen::Matrix3Xd places;
  /** \brief What rotation and scale are about: the mean of the places. */
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  /** \brief Root mean square distance of the places from it. */
  double radius = 0.0;
  /** \brief How large an eigenvalue per pair the errors of normals alone account for.
   */
  double normal_error = 0.0;
  /** \brief Whether there are enough pairs, and normals that say something. */
  bool are_usable = false;
};

/** \brief The equations of those pairs that have a counterpart. */
PairEquations
equationsOf(const SurfacePairs& pairs, const SurfaceStepSettings& settings);

/** \brief Weighted normal equations. */
struct NormalEquations {
  ChangeMatrix matrix = ChangeMatrix::Zero();
  Change gradient = Change::Zero();
  /** \brief Weights times residuals, and the sum of the weights. */
  Eigen::VectorXd pulls;
  double weights = 0.0;
  /** \brief The sum of the slopes of the pulls: how much they grow with residuals. */
  double slopes = 0.0;
  /** \brief Mean weighted square of the residuals, no less than rounding's. */
  double variance = 0.0;
};

/** \brief The normal equations where a change has been made, in which pairs far off the
 * others have no weight. */
NormalEquations
normalEquationsAt(const PairEquations& equations,
                  const Change& change,
                  const SurfaceStepSettings& settings);

/** \brief The smallest eigenvalue of the normal equations along which the pairs
 * determine the pose. */
double
smallestDetermined(const PairEquations& equations, const NormalEquations& normal);

} // namespace kss
} // namespace pcl
