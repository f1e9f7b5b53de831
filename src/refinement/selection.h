/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "geometry/pose_metric.h"
#include "refinement/shape_pair.h"
#include "refinement/overlap.h"
#include "refinement/refinement.h"

#include <functional>
#include <vector>

namespace pcl {
namespace kss {

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
  /** \param[in] shapes kept by reference
   * \param[in] threads 0: as many as there are cores; the result does not depend on it
   */
  Selection(const ShapePair& shapes, unsigned int threads);

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

  /** \brief A pose and what it costs. */
  struct Ranked {
    StoredPose pose;
    double cost;
  };

  /** \brief Refine poses, fewer and fewer of them with more and more points.
   * \param[in,out] ranked the best so far first, after each step
   * \throws Stopped
   */
  void
  refineMoreAndMore(std::vector<Ranked>& ranked,
                    const std::function<void(double)>& done) const;

  /** \brief The poses refined, by rising cost; of those closer together than \a
   * distinct one is kept. */
  template <typename Cost>
  std::vector<Ranked>
  refined(const Poses& poses,
          const Refinement& refinement,
          const Refinement::Effort& effort,
          const Cost& cost,
          double distinct) const;

  double
  truncatedMean(const Eigen::Matrix4d& pose, Eigen::Index points, double limit) const;

  const ShapePair& shapes_;
  unsigned int threads_;
};

} // namespace kss
} // namespace pcl
