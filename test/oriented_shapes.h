/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "shapes.h"

namespace kss_test {

/** \brief Points with the normals of the surface that they lie on, outwards. */
struct Oriented {
  Points points, normals;
};

/** \brief Points of an ellipsoid about the origin. */
inline Oriented
orientedEllipsoid(const Eigen::Vector3f& radii, Eigen::Index number, unsigned int seed)
{
  std::mt19937 random(seed);
  std::normal_distribution<float> coordinate;
  Oriented cloud{Points(3, number), Points(3, number)};
  for (Eigen::Index i = 0; i < number; ++i) {
    const Eigen::Vector3f unit =
        Eigen::Vector3f(coordinate(random), coordinate(random), coordinate(random))
            .normalized();
    cloud.points.col(i) = radii.cwiseProduct(unit);
    cloud.normals.col(i) = unit.cwiseQuotient(radii).normalized();
  }
  return cloud;
}

/** \brief Points of a box about the origin, spread evenly by area. */
inline Oriented
orientedBox(const Eigen::Vector3f& half, Eigen::Index number, unsigned int seed)
{
  const Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  const Points points = sampled(box(centre, half.cast<double>()), number, seed);
  Oriented cloud{points, Points::Zero(3, number)};
  for (Eigen::Index i = 0; i < number; ++i) {
    Eigen::Index axis;
    points.col(i).cwiseAbs().cwiseQuotient(half).maxCoeff(&axis);
    cloud.normals(axis, i) = points(axis, i) > 0.0f ? 1.0f : -1.0f;
  }
  return cloud;
}

} // namespace kss_test
