/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <Eigen/Core>

namespace pcl {
namespace kss {

/** \brief Places the source: the upper three rows of a similarity. */
using Placement = Eigen::Matrix<float, 3, 4, Eigen::RowMajor>;

} // namespace kss
} // namespace pcl
