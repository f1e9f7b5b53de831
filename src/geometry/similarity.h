/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "geometry/placement.h"

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace pcl {
namespace kss {

/** \brief A similarity: x -> scale * rotation * x + translation.
 *
 * Variables are named by their frames: T_target_source takes coordinates in the frame
 * of the source to those in the frame of the target, and T_a_b * T_b_c is T_a_c.
 */
struct Similarity {
  double scale = 1.0;
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();

  /** \brief From its 4x4 matrix, see isSimilarity(). */
  static Similarity
  of(const Eigen::Matrix4d& matrix);

  /** \brief Scale times rotation. */
  Eigen::Matrix3d
  linear() const;

  /** \brief The similarity that takes everything back: T_b_a of T_a_b. */
  Similarity
  inverse() const;

  /** \brief The 4x4 matrix. */
  Eigen::Matrix4d
  matrix() const;

  /** \brief Its upper three rows, as evaluators take them. */
  Placement
  placement() const;

  /** \brief For single points. */
  Eigen::Affine3f
  affine() const;

  /** \brief Whether all of it is numbers that points in single precision follow. */
  bool
  isUsable() const;
};

/** \brief First \a b, then \a a: T_a_c of T_a_b and T_b_c. */
Similarity
operator*(const Similarity& a, const Similarity& b);

} // namespace kss
} // namespace pcl
