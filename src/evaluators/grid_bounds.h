/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "evaluators/bounding_grid.h"
#include "evaluators/bounds.h"
#include "evaluators/probes.h"

#include <map>

namespace pcl {
namespace kss {

/** \brief What the bounds evaluators of all devices share: the probes, where the grids
 * lie, and rounding errors.
 */
class GridBounds : public BoundsEvaluator {
public:
  void
  setClouds(const Points& source,
            const Points& target,
            const BoundsScope& scope) override;

  std::vector<DistanceBounds>
  evaluate(const std::vector<Placement>& placements, Eigen::Index probes) override;

protected:
  /** \brief Probes of both clouds; none where the direction does not matter. */
  struct ProbesOfBoth {
    Probes source, target;
  };

  /** \brief Fill the cells around a cloud.
   * \param[in] is_source which cloud it is
   * \param[in] cloud its points
   * \param[in] grid around it
   */
  virtual void
  setCells(bool is_source, const Points& cloud, const BoundingGrid& grid) = 0;

  /** \brief The bounds, rounding errors aside.
   * \param[in] placements at least one
   * \param[in] probes what to look up
   * \param[in] interpolate whether to interpolate between nodes: closer and dearer
   * \param[in] limit what a distance counts in the means at most
   */
  virtual std::vector<DistanceBounds>
  lookedUp(const std::vector<Placement>& placements,
           const ProbesOfBoth& probes,
           bool interpolate,
           float limit) = 0;

private:
  BoundsScope scope_;
  Points source_, target_;
  std::map<Eigen::Index, ProbesOfBoth> probes_;
  float absolute_error_ = 0.0f, relative_error_ = 0.0f;
};

} // namespace kss
} // namespace pcl
