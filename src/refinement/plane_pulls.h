/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "geometry/similarity.h"

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
  /** \param[in] placed a placed point of the source
   * \param[in] target what it is pulled to
   * \param[in] normal unit normal of the plane, where it is placed
   * \param[in] weight
   */
  void
  add(const Eigen::Vector3f& placed,
      const Eigen::Vector3f& target,
      const Eigen::Vector3f& normal,
      float weight)
  {
    const Eigen::Vector3f off = placed - target, turn = placed.cross(normal);
    const float squeezed = (1.0f - epsilon) * weight;
    Eigen::Matrix<float, 6, 1> row;
    row << turn.x(), turn.y(), turn.z(), normal.x(), normal.y(), normal.z();
    matrix_.noalias() += squeezed * row * row.transpose();
    const Eigen::Vector3f moment = placed.cross(off);
    gradient_ += squeezed * normal.dot(off) * row;
    const float pull = epsilon * weight;
    for (int axis = 0; axis < 3; ++axis) {
      gradient_[axis] += pull * moment[axis];
      gradient_[3 + axis] += pull * off[axis];
    }
    weight_ += weight;
    places_ += weight * placed;
    products_.noalias() += weight * placed * placed.transpose();
  }

  /** \brief A pose moved as they ask for; as it is where they say nothing. */
  Similarity
  moved(const Similarity& pose) const;

private:
  /** What a correspondence pulls along its plane: as little as lets one part in a
   * hundred of a cloud decide where the rest is free to slide. */
  static constexpr float epsilon = 0.01f;

  Eigen::Matrix<float, 6, 6> matrix_ = Eigen::Matrix<float, 6, 6>::Zero();
  Eigen::Matrix<float, 6, 1> gradient_ = Eigen::Matrix<float, 6, 1>::Zero();
  float weight_ = 0.0f;
  Eigen::Vector3f places_ = Eigen::Vector3f::Zero();
  Eigen::Matrix3f products_ = Eigen::Matrix3f::Zero();
};

} // namespace kss
} // namespace pcl
