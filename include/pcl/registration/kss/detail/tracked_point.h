/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/detail/packed_tree.h>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace pcl {
namespace kss {

/** \brief Points are looked for that much farther than correspondences reach: what
 * finds none then needs not look again as soon as it moves. */
constexpr double looked_beyond = 1.25;

/** \brief The target points nearest to a point that moves, from one iteration of ICP to
 * the next.
 *
 * The nearest one stays the nearest as long as the point has moved by less than half
 * the difference to the second nearest: late iterations hardly need a search.
 */
class TrackedPoint {
public:
  /** \brief The index of the nearest target point; -1: none within the limit. */
  std::int32_t
  nearest() const
  {
    return nearest_;
  }

  /** \brief Find the nearest target point anew where it may be another one.
   * \param[in] place where the point has moved to
   * \param[in] limit points farther away are not looked for; may be infinite
   * \param[in] squaredTo the squared distance from the place to a target point
   * \param[in] search the two points nearest to the place, given the squared distance
   * beyond which none are looked for
   * \return the squared distance of the nearest one; infinite where there is none
   */
  template <typename SquaredTo, typename Search>
  float
  move(const Eigen::Vector3f& place,
       float limit,
       const SquaredTo& squaredTo,
       const Search& search)
  {
    constexpr float infinite = std::numeric_limits<float>::infinity();
    if (is_known_ && limit <= limit_ && (place - place_).squaredNorm() < squared_slack_)
      return nearest_ < 0 ? infinite : squaredTo(nearest_);
    float squared_limit = limit * limit;
    if (second_ >= 0) // the two of before, rounding aside
      squared_limit = std::min(
          squared_limit, 1.0001f * std::max(squaredTo(nearest_), squaredTo(second_)));
    const NearestTwo two = search(squared_limit);
    const float nearest = std::sqrt(two.squared);
    const float second = std::min(std::sqrt(two.second_squared), limit);
    // rounding aside
    const float slack =
        two.nearest >= 0
            ? 0.4999f * (second - nearest)
            : 0.999f * (1.0f - 1.0f / static_cast<float>(looked_beyond)) * limit;
    is_known_ = true;
    nearest_ = two.nearest;
    second_ = two.second;
    place_ = place;
    squared_slack_ = slack * std::abs(slack);
    limit_ = limit;
    return two.squared;
  }

private:
  bool is_known_ = false;
  std::int32_t nearest_ = -1;
  std::int32_t second_ = -1;
  Eigen::Vector3f place_;
  float squared_slack_ = 0.0f;
  float limit_ = 0.0f; ///< no point was looked for beyond
};

} // namespace kss
} // namespace pcl
