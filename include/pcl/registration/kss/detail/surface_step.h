/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/detail/points.h>
#include <pcl/registration/kss/export.h>
#include <pcl/registration/kss/settings.h>

#include <Eigen/Core>

namespace pcl {
namespace kss {

/** \brief Matched points of two surfaces, a column per pair. */
struct SurfacePairs {
  Eigen::Matrix3Xd source;         ///< points, where the pose so far has placed them
  Eigen::Matrix3Xd target;         ///< the points that they are matched with
  Eigen::Matrix3Xd source_normals; ///< of unit length and either sign
  Eigen::Matrix3Xd target_normals; ///< of unit length and either sign
};

/** \brief What a step may change, and how precise the pairs are. */
struct SurfaceStepSettings {
  /** \brief The bounds of the scale of the step; equal ones: it is not estimated. */
  double smallest_scale = 1.0, largest_scale = 1.0;
  /** \brief What the rotation of the step is about. */
  RotationAxis rotation_axis = RotationAxis::ANY;
  /** \brief The distance of two points that rounding alone accounts for. */
  double rounding_error = 0.0;
  /** \brief How far normals are off, root mean square, in radians. */
  double source_normal_error = 0.0, target_normal_error = 0.0;
  /** \brief Whether half of the pairs at most may lie on another skin than the right
   * one: the nearer ones then tell how far off pairs are. */
  bool has_skins = false;
  /** \brief The length of a step as a share of the one before, both in standard errors:
   * what matching anew takes back of a step. In [0, 1). */
  double contraction = 0.0;
};

/** \brief A step of ICP on surfaces, and what it was found from. */
struct SurfaceStep {
  /** \brief The similarity that moves the source. */
  StoredPose transformation = StoredPose::Identity();
  /** \brief Whether there were pairs enough for one. */
  bool is_found = false;
  /** \brief The directions of the pose that the surfaces do not determine; the step
   * keeps clear of them. */
  int undetermined = 0;
  /** \brief The square of the step in standard errors, mean over the directions. */
  double squared_errors_moved = 0.0;
};

/** \brief How precisely matched surfaces determine the pose that they are in. */
struct SurfacePrecision {
  /** \brief Rotation (radians about the axes), translation of the center, and, where it
   * is estimated, the logarithm of the scale: how many of these. */
  int unknowns = 0;
  /** \brief Their covariance, in the upper left corner; zeros for rotations that there
   * may not be. */
  Eigen::Matrix<double, 7, 7, Eigen::DontAlign> covariance =
      Eigen::Matrix<double, 7, 7, Eigen::DontAlign>::Zero();
  /** \brief The directions of the pose that the surfaces do not determine. */
  int undetermined = 0;
};

/** \brief Find the similarity that lays a surface on another one, given points that
 * match about.
 *
 * The distances to each other's tangent planes are minimized (S. Rusinkiewicz, "A
 * Symmetric Objective Function for ICP", ACM Transactions on Graphics, 2019), the scale
 * included; pairs far off the others have no say.
 */
PCL_KSS_ICP_EXPORT SurfaceStep
surfaceStep(const SurfacePairs& pairs, const SurfaceStepSettings& settings);

/** \brief How precisely matched points determine the pose that the source is in.
 * \param[in] center of the source, which its translation is that of
 */
PCL_KSS_ICP_EXPORT SurfacePrecision
surfacePrecision(const SurfacePairs& pairs,
                 const SurfaceStepSettings& settings,
                 const Eigen::Vector3d& center);

} // namespace kss
} // namespace pcl
