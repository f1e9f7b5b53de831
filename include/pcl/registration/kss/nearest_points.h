/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/distance_field.h>
#include <pcl/registration/kss/neighbourhoods.h>
#include <pcl/registration/kss/points.h>

namespace pcl {
namespace kss {

/** \brief Finds nearest points in a few dozen nanoseconds: a distance field gives a
 * point near the position, and from there neighbours lead closer as long as they can.
 *
 * Near the points the answer is the nearest point or, rarely, one hardly farther away.
 * From afar, where nothing depends on it, it can be a fifth farther.
 */
class NearestPoints {
public:
  /** \param[in] points at least one
   * \param[in] threads for the preparation; 0: as many as there are cores
   */
  NearestPoints(const Points& points, unsigned int threads);

  /** \brief A point near a position: the one nearest to the centre of its cell.
   * \param[in] position anywhere
   * \param[out] squared_distance of the two
   * \return its index
   */
  int
  near(const Eigen::Vector3f& position, float& squared_distance) const
  {
    const int point = field_.nearest(field_.cellOf(position));
    squared_distance = (points_.col(point) - position).squaredNorm();
    return point;
  }

  /** \brief The point nearest to a position.
   * \param[in] position anywhere
   * \param[out] squared_distance of the two
   * \return its index
   */
  int
  nearest(const Eigen::Vector3f& position, float& squared_distance) const
  {
    int best = near(position, squared_distance);
    for (bool closer = true; closer;) {
      closer = false;
      const auto around = neighbourhoods_.indices.col(best);
      for (Eigen::Index n = 0; n < around.size(); ++n) {
        const float squared = (points_.col(around[n]) - position).squaredNorm();
        if (squared < squared_distance) {
          squared_distance = squared;
          best = around[n];
          closer = true;
        }
      }
    }
    return best;
  }

  /** \brief The points. */
  const Points&
  points() const
  {
    return points_;
  }

  /** \brief The spacing of the points around each of them; see spacingOf(). */
  const Eigen::VectorXf&
  spacing() const
  {
    return spacing_;
  }

private:
  Points points_;
  Neighbourhoods neighbourhoods_;
  Eigen::VectorXf spacing_;
  DistanceField field_;
};

} // namespace kss
} // namespace pcl
