/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "candidates/energy.h"

namespace pcl {
namespace kss {

float
energyOf(const DirectedDistances& distances, const Weights& weights, Energy energy)
{
  switch (energy) {
  case Energy::HAUSDORFF:
    return std::max(weights.source_to_target * distances.source_to_target,
                    weights.target_to_source * distances.target_to_source);
  case Energy::TRUNCATED_MEAN:
    break;
  }
  return weights.source_to_target * distances.mean_source_to_target +
         weights.target_to_source * distances.mean_target_to_source;
}

} // namespace kss
} // namespace pcl
