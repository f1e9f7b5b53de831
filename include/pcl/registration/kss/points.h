/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <Eigen/Geometry>

namespace pcl {
namespace kss {

/** \brief The coordinates of a cloud, a column per point, all finite. */
using Points = Eigen::Matrix3Xf;

/** \brief A cloud in a frame of its own, so that its floats do not lose digits to its
 * place in the world.
 */
struct LocalCloud {
  /** \brief Coordinates minus \ref origin. */
  Points points;
  /** \brief Where the local frame lies: near the middle of the cloud. */
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
};

} // namespace kss
} // namespace pcl
