/*
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * What single points say about a pose, and when surfaces explain them.
 */

#pragma once

#include "geometry/oriented_points.h"
#include "geometry/similarity.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>

namespace pcl {
namespace kss {

/** \brief How near a surface a point has to be, in spacings: beyond, none of the other
 * sampling of the same surface is expected to be found. */
constexpr float near_spacings = 2.5f;

/** \brief How far off its plane, in standard deviations of the noise: one in eighty of
 * a normal distribution is farther. */
constexpr float within_noise = 2.5f;

/** \brief Noise, in spacings, below which planes of a dozen neighbours cannot be
 * trusted: what a surface bends within them, and what scanners distort. */
constexpr float least_noise = 0.1f;

/** \brief By how much less than those of neighbours they may agree where they are not,
 * and the least that still is agreement. */
constexpr float less_than_neighbours = 0.1f, least_agreeing = 0.3f;

/** \brief By how much a point's distance from its plane changes with shifts along the
 * axes, with turns about them and with the scale, each by as much as moves the cloud by
 * one unit. */
using PoseRow = Eigen::Matrix<float, 7, 1>;

/** \brief A cloud where a pose has placed it. */
class PlacedSurface {
public:
  /** \param[in] cloud kept by reference */
  PlacedSurface(const OrientedPoints& cloud, const Similarity& pose)
  : cloud_(cloud)
  , placement_(pose.affine())
  , rotation_(pose.rotation.cast<float>())
  , scale_(static_cast<float>(pose.scale))
  , center_(placement_ * cloud.points->middle())
  , radius_(scale_ * cloud.points->radius())
  {
  }

  /** \brief The mean of the placed points. */
  const Eigen::Vector3f&
  center() const
  {
    return center_;
  }

  /** \brief Their root mean square distance from it. */
  float
  radius() const
  {
    return radius_;
  }

  /** \brief A point, placed. */
  Eigen::Vector3f
  point(Eigen::Index i) const
  {
    return placement_ * cloud_.points->points().col(i);
  }

  /** \brief Its normal. */
  Eigen::Vector3f
  normal(Eigen::Index i) const
  {
    return rotation_ * cloud_.planes.normals.col(i);
  }

  /** \brief How far its neighbours lie off its plane, where they are placed. */
  float
  deviation(Eigen::Index i) const
  {
    return scale_ * cloud_.planes.deviations[i];
  }

  /** \brief How well its normal agrees with theirs. */
  float
  agreement(Eigen::Index i) const
  {
    return cloud_.planes.agreements[i];
  }

  /** \brief The spacing of the placed points around it. */
  float
  spacing(Eigen::Index i) const
  {
    return scale_ * cloud_.points->spacing()[i];
  }

  /** \brief Whether the normals tell which side is outside. */
  bool
  hasSides() const
  {
    return cloud_.planes.has_sides;
  }

  /** \brief What a point says about the pose. */
  PoseRow
  row(const Eigen::Vector3f& point, const Eigen::Vector3f& normal) const
  {
    const Eigen::Vector3f arm = (point - center_) / radius_;
    const Eigen::Vector3f turn = arm.cross(normal);
    PoseRow row;
    row << normal.x(), normal.y(), normal.z(), turn.x(), turn.y(), turn.z(),
        normal.dot(arm);
    return row;
  }

private:
  const OrientedPoints& cloud_;
  Eigen::Affine3f placement_;
  Eigen::Matrix3f rotation_;
  float scale_;
  Eigen::Vector3f center_;
  float radius_;
};

/** \brief What a surface says of a point near it. */
struct Explanation {
  bool is_near = false;      ///< whether the surface is near the point
  bool is_explained = false; ///< whether it explains the point
  float off = 0.0f;          ///< how far off its plane, in standard deviations
};

/** \brief Ask a surface for a placed point of another one.
 * \param[in] to the surface
 * \param[in] from the other one
 * \param[in] i the point
 * \param[in] noise of both, standard deviation
 */
inline Explanation
explanationOf(const OrientedPoints& to,
              const PlacedSurface& from,
              Eigen::Index i,
              float noise)
{
  Explanation found;
  const Eigen::Vector3f point = from.point(i);
  float squared;
  const int other = to.points->nearest(point, squared);
  const float spacing = std::max(from.spacing(i), to.points->spacing()[other]);
  if (squared > near_spacings * near_spacings * spacing * spacing)
    return found;
  found.is_near = true;
  const TangentPlanes& planes = to.planes;
  const Eigen::Vector3f to_normal = planes.normals.col(other);
  const float cosine = from.normal(i).dot(to_normal);
  const float agreement =
      from.hasSides() && planes.has_sides ? cosine : std::abs(cosine);
  const float off = std::abs(to_normal.dot(point - to.points->points().col(other)));
  // nearest points say no more than neighbours on their own surfaces would
  found.off = off / std::max({noise, least_noise * spacing, from.deviation(i),
                              planes.deviations[other]});
  const float usual =
      std::min(from.agreement(i), planes.agreements[other]) - less_than_neighbours;
  found.is_explained = agreement >= std::clamp(usual, least_agreeing, agreeing) &&
                       found.off <= within_noise;
  return found;
}

} // namespace kss
} // namespace pcl
