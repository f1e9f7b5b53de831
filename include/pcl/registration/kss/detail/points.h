/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <Eigen/Geometry>

namespace pcl {
namespace kss {

/** \brief The coordinates of a cloud, a column per point, all finite. */
using Points = Eigen::Matrix3Xf;

/** \brief A pose that a structure holds: aligned for no vector width, so that the
 * structure has one layout whatever a program is compiled for, and may be moved by what
 * cares for no alignment, such as the buffer of std::stable_sort.
 */
using StoredPose = Eigen::Matrix<double, 4, 4, Eigen::DontAlign>;

/** \brief A cloud in a frame of its own, so that its floats do not lose digits to its
 * place in the world.
 */
struct LocalCloud {
  /** \brief Coordinates minus \ref origin. */
  Points points;
  /** \brief Where the local frame lies: near the middle of the cloud. */
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  /** \brief Unit normals that came with the points, a column per point; a zero column:
   * unknown; no columns: to be found from the points.
   */
  Points normals{};
};

} // namespace kss
} // namespace pcl
