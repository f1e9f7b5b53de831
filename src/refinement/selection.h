/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/result.h>

#include "geometry/similarity.h"
#include "preparation/shape_pair.h"
#include "refinement/selection_steps.h"

#include <functional>
#include <vector>

namespace pcl {
namespace kss {

/** \brief The choice among local minima: the additional process of (e12).
 *
 * All poses are refined with few points, and fewer and fewer of them with more. First
 * they are ranked by how near the clouds come to each other, which leads from afar, in
 * the end by their overlap, which tells right from wrong: see selection_steps.h.
 */
class Selection {
public:
  /** \param[in] shapes kept by reference
   * \param[in] effort how many of the poses are looked into
   * \param[in] threads 0: as many as there are cores; the result does not depend on it
   */
  Selection(const ShapePair& shapes,
            const SelectionEffort& effort,
            unsigned int threads);

  /** \brief The distinct poses that refinement leads to, the best first; as many as the
   * effort says at most. Where the work is stopped, as far as they have come.
   * \param[in] poses at least one
   * \param[in] done told the share of the work that is done
   */
  std::vector<Similarity>
  best(const std::vector<Similarity>& poses,
       const std::function<void(double)>& done) const;

private:
  /** \brief A pose and what it costs. */
  struct Ranked {
    Similarity pose;
    double cost;
  };

  /** \brief Refine poses, fewer and fewer of them with more and more points.
   * \param[in,out] ranked the best so far first, after each step
   * \throws Stopped
   */
  void
  refineMoreAndMore(std::vector<Ranked>& ranked,
                    const std::function<void(double)>& done) const;

  /** \brief One step: the poses refined, by rising cost. */
  std::vector<Ranked>
  refined(const std::vector<Ranked>& ranked, const SelectionStep& step) const;

  double
  costOf(const Similarity& pose, const SelectionStep& step) const;

  double
  truncatedMean(const Similarity& pose, Eigen::Index points, double limit) const;

  const ShapePair& shapes_;
  SelectionEffort effort_;
  unsigned int threads_;
  SurfacePoints source_, target_;        ///< what poses are refined and ranked by
  Points source_probes_, target_probes_; ///< of all of the clouds
};

} // namespace kss
} // namespace pcl
