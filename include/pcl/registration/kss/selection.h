/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/nearest_points.h>
#include <pcl/registration/kss/overlap.h>
#include <pcl/registration/kss/pose_metric.h>
#include <pcl/registration/kss/pre_shape.h>
#include <pcl/registration/kss/refinement.h>

#include <functional>
#include <vector>

namespace pcl {
namespace kss {

/** \brief A cloud in pre-shape space, simplified for the search and as it is (clean,
 * and no larger than needed) for refinement and judgement. */
struct Shape {
  PreShape simplified;
  NearestPoints all;
};

/** \brief A pose between pre-shapes, and how much of the clouds lies on each other
 * there.
 */
struct JudgedPose {
  StoredPose pose;
  Overlap overlap;
};

/** \brief The choice among local minima: the additional process of (e12).
 *
 * All poses are refined with few points, and fewer and fewer of them with more. First
 * they are ranked by how near the clouds come to each other, which leads from afar, in
 * the end by their overlap, which tells right from wrong.
 */
class Selection {
public:
  /** \param[in] source kept by reference
   * \param[in] target kept by reference
   * \param[in] metric kept by reference
   * \param[in] scales what the scale of a pose is bound to
   * \param[in] noisy whether heavy noise has been averaged away, which leaves shallow
   * minima beside the right one
   * \param[in] threads 0: as many as there are cores; the result does not depend on it
   */
  Selection(const Shape& source,
            const Shape& target,
            const PoseMetric& metric,
            const ScaleRange& scales,
            bool noisy,
            unsigned int threads);

  /** \brief The distinct poses that refinement leads to, by falling score; five at
   * most. Where the work is stopped, as far as they have come.
   * \param[in] poses at least one
   * \param[in] done told the share of the work that is done
   */
  std::vector<JudgedPose>
  best(const std::vector<Eigen::Matrix4d>& poses,
       const std::function<void(double)>& done) const;

private:
  using Poses = std::vector<Eigen::Matrix4d>;

  /** \brief A pose and how bad it is. */
  struct Ranked {
    StoredPose pose;
    double badness;
  };

  /** \brief Refine poses, fewer and fewer of them with more and more points.
   * \param[in,out] ranked the best so far first, after each step
   * \throws Stopped
   */
  void
  refineMoreAndMore(std::vector<Ranked>& ranked,
                    const std::function<void(double)>& done) const;

  /** \brief The poses refined, by rising badness; of those closer together than \a
   * distinct one is kept. */
  template <typename Badness>
  std::vector<Ranked>
  refined(const Poses& poses,
          const Refinement& refinement,
          const Refinement::Effort& effort,
          const Badness& badness,
          double distinct) const;

  double
  truncatedMean(const Eigen::Matrix4d& pose, Eigen::Index points, double limit) const;

  const Shape &source_, &target_;
  const PoseMetric& metric_;
  ScaleRange scales_;
  bool noisy_;
  unsigned int threads_;
};

} // namespace kss
} // namespace pcl
