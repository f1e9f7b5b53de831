/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/detail/points.h>

#include "geometry/similarity.h"

#include <Eigen/Core>

#include <cmath>
#include <vector>

namespace pcl {
namespace kss {

/** \brief Poses that place the source less far apart, root mean square, in root mean
 * square radii of the target, are the same for the choice among minima; so are
 * rotations that differ by less, in radians. */
constexpr double same_pose = M_PI / 18.0;

/** \brief How far apart two poses place a cloud. */
class PoseMetric {
public:
  /** \brief A pose, such that the Euclidean distance is the root mean square distance
   * of the placed points. */
  using Place = Eigen::Matrix<float, 12, 1>;

  /** \param[in] cloud what the poses place; centred */
  explicit PoseMetric(const Points& cloud);

  Place
  placeOf(const Similarity& pose) const;

  double
  distance(const Similarity& a, const Similarity& b) const;

private:
  Eigen::Matrix3f spread_;
};

/** \brief Takes poses one by one and tells those that are new. */
class DistinctPoses {
public:
  /** \param[in] metric kept by reference
   * \param[in] distance poses closer than this are the same
   */
  DistinctPoses(const PoseMetric& metric, double distance)
  : metric_(metric)
  , squared_(static_cast<float>(distance * distance))
  {
  }

  /** \brief Whether none of the poses taken before is the same; if so, it is taken. */
  bool
  take(const Similarity& pose)
  {
    const PoseMetric::Place place = metric_.placeOf(pose);
    for (const PoseMetric::Place& other : places_)
      if ((place - other).squaredNorm() < squared_)
        return false;
    places_.push_back(place);
    return true;
  }

  /** \brief How many have been taken. */
  std::size_t
  size() const
  {
    return places_.size();
  }

private:
  const PoseMetric& metric_;
  float squared_;
  std::vector<PoseMetric::Place> places_;
};

} // namespace kss
} // namespace pcl
