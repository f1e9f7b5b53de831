/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/detail/points.h>
#include <pcl/registration/kss/settings.h>

#include <Eigen/Core>

namespace pcl {
namespace kss {

/** \brief The axes, a column each, whose turns rotations are made of. */
using Turns = Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 3>;

/** \brief All three axes, or the one that rotations are about. */
Turns
turnsOf(RotationAxis axis);

/** \brief Of the rotations about an axis the one with the largest trace of R'M: the
 * rotation nearest to M, and, where M is the sum of t s', the one that takes points s
 * closest to points t. Its determinant cannot become a mirror's.
 */
Eigen::Matrix3d
nearestRotation(const Eigen::Matrix3d& matrix, RotationAxis axis);

/** \brief A similarity whose rotation is about an axis, near another one, which takes
 * one point to the same place.
 * \param[in] point in the frame of the source
 */
StoredPose
turnedAbout(RotationAxis axis,
            const StoredPose& similarity,
            const Eigen::Vector3d& point);

} // namespace kss
} // namespace pcl
