/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "geometry/similarity.h"
#include "geometry/turns.h"

#include <Eigen/Core>

namespace pcl {
namespace kss {

/** \brief The motion that weighted correspondences ask for, of which each pulls a point
 * towards a plane, and a little towards the point that the plane is of.
 *
 * For pairs alone a plane is a wall of points: a cloud that has to slide along a ground
 * or a table is held by most of its correspondences, and moves by what few others pull
 * it. Distances to planes leave it free. Chen and Medioni's point-to-plane metric, with
 * the regularization of Segal, Haehnel and Thrun's Generalized-ICP, sec. III-C: the
 * inverse covariance of a pair is n n' + epsilon (I - n n').
 */
class PlanePulls {
public:
  /** \brief A row for each coordinate. */
  using Rows = Eigen::Matrix<float, 3, Eigen::Dynamic, Eigen::RowMajor>;

  /** \brief Sums along normals, turns before shifts: the lower half of the equations'
   * matrix, row by row, and what they are to be solved for. */
  static constexpr int unknowns = 6, gradient_along = 21,
                       along_sums = gradient_along + unknowns;

  /** \brief Sums towards points: the weights, these times places, times products of
   * places (xx, xy, xz, yy, yz, zz), and times moments and ways. */
  static constexpr int gradient_towards = 10,
                       towards_sums = gradient_towards + unknowns;

  /** \param[in] placed placed points of the source, filled up to whole vectors
   * \param[in] target what they are pulled to
   * \param[in] normals unit normals of the planes, where they are placed
   * \param[in] weights 0 for what fills up
   */
  void
  add(const Rows& placed,
      const Rows& target,
      const Rows& normals,
      const Eigen::RowVectorXf& weights);

  /** \brief A pose moved as they ask for; as it is where they say nothing.
   * \param[in] turns the axes that it may be turned about
   */
  Similarity
  moved(const Similarity& pose, const Turns& turns) const;

private:
  /** What a correspondence pulls along its plane: as little as lets one part in a
   * hundred of a cloud decide where the rest is free to slide. */
  static constexpr float epsilon = 0.01f;

  double along_[along_sums] = {};
  double towards_[towards_sums] = {};
};

} // namespace kss
} // namespace pcl
