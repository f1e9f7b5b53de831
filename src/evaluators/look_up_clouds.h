/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "geometry/clouds.h"
#include "geometry/distance_field.h"

#include <algorithm>
#include <optional>
#include <tuple>

namespace pcl {
namespace kss {

/** \brief The field that a search looks distances up in: fine enough for the limit
 * beyond which a distance does not count, and small enough for a processor's cache.
 */
inline DistanceField
lookUpField(const Points& points, float limit)
{
  // a cell as wide as this leaves a distance off by 0.3 of the limit at most
  constexpr float cell_of_limit = 0.35f;
  // some fifty cells along the cloud
  constexpr float cell_of_cloud = 0.02f;
  // the limit is wider in the frame of a source that the pose shrinks
  constexpr float margin = 2.0f;
  const float extent = longestEdge(points);
  const float counts = std::min(limit, 0.25f * extent);
  return DistanceField(
      points,
      std::max(cell_of_limit * counts, cell_of_cloud * extent * coarseness(points)),
      margin * counts);
}

/** \brief Source and target of look-ups, with what an evaluator makes of each, which is
 * kept for as long as the cloud and the limit stay the same.
 */
template <typename Made>
class LookUpClouds {
public:
  /** \param[in] probes points of each cloud, the first ones, that are looked up */
  explicit LookUpClouds(unsigned int probes)
  : probes_(probes)
  {
  }

  /** \brief Set the two clouds.
   * \param[in] source at least one point
   * \param[in] target at least one point
   * \param[in] limit what a distance counts in the means at most
   * \param[in] make make(probes, field): what the evaluator needs of a cloud
   */
  template <typename Make>
  void
  set(const Points& source, const Points& target, float limit, const Make& make)
  {
    if (limit != limit_)
      source_ = target_ = Kept();
    limit_ = limit;
    for (const auto& [kept, cloud] :
         {std::tie(source_, source), std::tie(target_, target)})
      if (!areEqual(kept.cloud, cloud))
        kept = {cloud, make(cloud.leftCols(std::min(probes_, cloud.cols())),
                            lookUpField(cloud, limit))};
  }

  const Made&
  source() const
  {
    return *source_.made;
  }

  const Made&
  target() const
  {
    return *target_.made;
  }

  float
  limit() const
  {
    return limit_;
  }

private:
  struct Kept {
    Points cloud;
    std::optional<Made> made;
  };

  Eigen::Index probes_;
  Kept source_, target_;
  float limit_ = 0.0f;
};

} // namespace kss
} // namespace pcl
