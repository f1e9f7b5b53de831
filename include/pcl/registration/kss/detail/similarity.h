/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/export.h>

#include <Eigen/Core>

namespace pcl {
namespace kss {

/** \brief Whether a matrix is a rotation, translation and positive scale, all of them
 * numbers that points in single precision can follow. Every pose that is searched from,
 * judged or returned is.
 */
PCL_KSS_ICP_EXPORT bool
isSimilarity(const Eigen::Matrix4d& matrix);

/** \brief The scale of a similarity: the cube root of its determinant. */
PCL_KSS_ICP_EXPORT double
scaleOf(const Eigen::Matrix4d& similarity);

} // namespace kss
} // namespace pcl
