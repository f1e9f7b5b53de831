/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/detail/points.h>

#include "geometry/nearest_points.h"
#include "geometry/scale_range.h"
#include "geometry/similarity.h"
#include "geometry/turns.h"

#include <Eigen/Core>

#include <memory>

namespace pcl {
namespace kss {

/** \brief Points of a surface, and its normals there. */
struct SurfacePoints {
  std::shared_ptr<const NearestPoints> points;
  Points normals; ///< a column per point
};

/** \brief ICP between two clouds, with correspondences both ways that count less the
 * longer they are.
 *
 * Every source point pulls towards its nearest target point and every target point
 * pulls its nearest source point. With Horn's symmetric scale (the ratio of the
 * spreads) this has no preferred direction: one-sided nearest neighbours would shrink
 * the source under noise.
 *
 * A correspondence of length d has the weight of Geman and McClure, (r^2 / (r^2 +
 * d^2))^2, and the reach r falls from iteration to iteration: far parts lead the way
 * first, and parts without a counterpart have no say in the end.
 */
class Refinement {
public:
  /** \brief How many points take part, how long, and how far they reach. */
  struct Effort {
    /** \brief Points of each cloud whose correspondences are used: the first ones. */
    Eigen::Index points;
    /** \brief Iterations. */
    int iterations;
    /** \brief The reach at the first iteration. */
    double widest;
    /** \brief The reach from the middle of the iterations on. */
    double narrowest;
    /** \brief Whether correspondences are the nearest points, or just near ones, which
     * is several times faster and good enough from afar. */
    bool exact;
    /** \brief Whether correspondences pull towards the planes of surfaces, along which
     * clouds are free to slide, or towards points, which leads from farther off. */
    bool on_planes = false;
  };

  /** \param[in] source_probes points of the source that seek their nearest; any leading
   * part of them covers the cloud
   * \param[in] target_probes as many of the target
   * \param[in] source all points of the source, kept by reference
   * \param[in] target all points of the target, kept by reference
   * \param[in] scales what the scale is bound to; one value leaves it as it is
   * \param[in] axis what rotations are about
   */
  Refinement(const Points& source_probes,
             const Points& target_probes,
             const SurfacePoints& source,
             const SurfacePoints& target,
             const ScaleRange& scales,
             RotationAxis axis = RotationAxis::ANY);

  /** \brief Refine a pose; safe to call from several threads at once. */
  Similarity
  refine(const Similarity& initial, const Effort& effort) const;

private:
  const Points& source_probes_;
  const Points& target_probes_;
  const SurfacePoints& source_;
  const SurfacePoints& target_;
  ScaleRange scales_;
  RotationAxis axis_;
};

} // namespace kss
} // namespace pcl
