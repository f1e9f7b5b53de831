/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "geometry/clouds.h"
#include "geometry/distance_field.h"

#include <algorithm>

namespace pcl {
namespace kss {

/** \brief The field that a search looks distances up in: fine enough for the limit
 * beyond which a distance does not count, and small enough for a processor's cache.
 */
inline DistanceField
lookUpField(const Points& points, float limit)
{
  const float extent = longestEdge(points);
  const float counts = std::min(limit, 0.25f * extent);
  // the limit is wider in the frame of a source that the pose shrinks
  return DistanceField(points,
                       std::max(0.35f * counts, 0.02f * extent * coarseness(points)),
                       2.0f * counts);
}

} // namespace kss
} // namespace pcl
