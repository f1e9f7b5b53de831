/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/detail/points.h>

#include "candidates/energy.h"
#include "geometry/placement.h"

#include <limits>
#include <string>
#include <vector>

namespace pcl {
namespace kss {

/** \brief Computes the distances of many placements of one source on one target. */
class DistanceEvaluator {
public:
  virtual ~DistanceEvaluator() = default;

  /** \brief Set the two clouds.
   * \param[in] source at least one point
   * \param[in] target at least one point
   * \param[in] limit what a distance counts in the means at most
   */
  virtual void
  setClouds(const Points& source,
            const Points& target,
            float limit = std::numeric_limits<float>::max()) = 0;

  /** \brief The distances of all placements, in their order. */
  virtual std::vector<DirectedDistances>
  evaluate(const std::vector<Placement>& placements) = 0;

  /** \brief The name of the device that does the work. */
  virtual std::string
  deviceName() const = 0;
};

} // namespace kss
} // namespace pcl
