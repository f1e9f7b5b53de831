/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/detail/bulk.h>
#include <pcl/registration/kss/detail/packed_tree.h>
#include <pcl/registration/kss/detail/points.h>

#include <Eigen/Core>

#include <cstddef>
#include <memory>

namespace pcl {
namespace kss {

struct PreparedCloud;

/** \brief What registrations ask of a cloud, as source or as target. */
struct PreparedScan {
  /** \brief Its usable points, as far as it is a target. */
  LocalCloud local;
  Bulk bulk;
  std::size_t far = 0; ///< points that are too far away from the others
  /** \brief Points that take part in the final ICP as far as it is a source, sorted in
   * space. */
  Eigen::Matrix3Xd used;
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
  /** \brief How far floats in the local frame are off. */
  double rounding_error = 0.0;
  std::shared_ptr<const PackedTree> tree; ///< of the local points
  std::shared_ptr<const PreparedCloud> prepared;
};

} // namespace kss
} // namespace pcl
