/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/detail/points.h>

#include "geometry/distance_field.h"
#include "geometry/neighbourhoods.h"
#include "support/wide_vectors.h"

#include <limits>
#include <vector>

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

  /** \param[in] points at least one
   * \param[in] neighbourhoods of the points
   * \param[in] unit of the points, in that of the neighbourhoods' distances
   */
  NearestPoints(Points points, const Neighbourhoods& neighbourhoods, float unit = 1.0f);

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
    for (;;) {
      const Around& around = around_[best];
      float squared[neighbours];
      around.squaredDistances(position, squared);
      unsigned int closer = whichBelow(squared, squared_distance);
      if (closer == 0)
        return best;
      for (; closer != 0; closer &= closer - 1) {
        const int n = __builtin_ctz(closer);
        if (squared[n] < squared_distance) {
          squared_distance = squared[n];
          best = around.indices[n];
        }
      }
    }
  }

  /** \brief The point nearest to a position, and how near the second nearest is.
   * \param[in] position anywhere
   * \param[out] squared_distance of the two
   * \param[out] second_squared_distance the next larger one; infinite where there is no
   * other point
   * \return its index
   */
  int
  nearest(const Eigen::Vector3f& position,
          float& squared_distance,
          float& second_squared_distance) const
  {
    int best = near(position, squared_distance);
    second_squared_distance = std::numeric_limits<float>::infinity();
    for (int from = -1; from != best;) {
      from = best;
      const Around& around = around_[from];
      float squared[neighbours];
      around.squaredDistances(position, squared);
      for (int n = 0; n < neighbours; ++n)
        if (squared[n] < squared_distance) {
          second_squared_distance = squared_distance;
          squared_distance = squared[n];
          best = around.indices[n];
        }
        else if (squared[n] < second_squared_distance && around.indices[n] != best)
          second_squared_distance = squared[n];
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

  /** \brief Its median. */
  float
  usualSpacing() const
  {
    return usual_spacing_;
  }

  /** \brief The mean of the points. */
  const Eigen::Vector3f&
  middle() const
  {
    return middle_;
  }

  /** \brief Their root mean square distance from it. */
  float
  radius() const
  {
    return radius_;
  }

private:
  /** Enough for nearly every direction to have a neighbour in it, and whole vectors. */
  static constexpr int neighbours = 12;

  /** The neighbours of a point, coordinates apart; where there are fewer, copies. */
  struct Around {
    float x[neighbours], y[neighbours], z[neighbours];
    int indices[neighbours];

    void
    squaredDistances(const Eigen::Vector3f& position, float* squared) const
    {
      const float px = position.x(), py = position.y(), pz = position.z();
      for (int n = 0; n < neighbours; ++n)
        squared[n] = (x[n] - px) * (x[n] - px) + (y[n] - py) * (y[n] - py) +
                     (z[n] - pz) * (z[n] - pz);
    }
  };

  Points points_;
  std::vector<Around> around_;
  Eigen::VectorXf spacing_;
  float usual_spacing_;
  Eigen::Vector3f middle_;
  float radius_;
  DistanceField field_;
};

} // namespace kss
} // namespace pcl
