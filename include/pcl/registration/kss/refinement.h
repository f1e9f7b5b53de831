/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/point_types.h>
#include <pcl/registration/kss/points.h>
#include <pcl/search/kdtree.h>

#include <Eigen/Core>

namespace pcl {
namespace kss {

/** \brief ICP between two simplified clouds, with correspondences both ways.
 *
 * Every source point pulls towards its nearest target point and every target point
 * pulls its nearest source point. With Horn's symmetric scale (the ratio of the
 * spreads) this has no preferred direction: one-sided nearest neighbours would shrink
 * the source under noise.
 */
class Refinement {
public:
  /** \brief When to stop, and how many points take part. */
  struct Effort {
    /** \brief Points of each cloud whose correspondences are used; 0: all. */
    unsigned int points = 0;
    /** \brief Iterations at most. */
    unsigned int iterations = 30;
    /** \brief Largest change of a matrix entry that ends it, in pre-shape units. */
    double tolerance = 1e-5;
  };

  /** \param[in] source points of a pre-shape
   * \param[in] target points of a pre-shape
   */
  Refinement(const Points& source, const Points& target);

  /** \brief Refine a pose.
   * \param[in] pose a similarity from source to target
   * \param[in] estimate_scale otherwise the pose's scale stays as it is
   * \param[in] effort when to stop
   * \return the refined pose; safe to call from several threads at once
   */
  Eigen::Matrix4d
  refine(const Eigen::Matrix4d& pose, bool estimate_scale, Effort effort) const;

private:
  Points source_, target_;
  search::KdTree<PointXYZ> source_tree_, target_tree_;
};

} // namespace kss
} // namespace pcl
