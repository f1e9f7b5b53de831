/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/detail/points.h>

#include "geometry/similarity.h"

namespace pcl {
namespace kss {

/** \brief A cloud's representation K_s in pre-shape space: centred, of unit size
 * (or, where the scale of a pair is known, a source of the target's unit). */
struct PreShape {
  /** \brief (x - center) / size of every point. */
  Points points;
  /** \brief The mean of the points, in the frame of the cloud. */
  Eigen::Vector3d center;
  /** \brief The centroid size over the square root of the number of points. */
  double size;

  /** \brief From pre-shape coordinates y to those of the cloud: x = center + size y. */
  Similarity
  T_cloud_shape() const
  {
    return {size, Eigen::Matrix3d::Identity(), center};
  }
};

/** \brief Map a cloud to pre-shape space, (e2) of the paper.
 *
 * The paper prints s(a) as the root of a sum of norms, which does not scale with a;
 * Kendall's centroid size, the root of the sum of \e squared norms, does. It grows with
 * the root of the number of points, so it is divided by that: the root mean square
 * radius becomes 1, and clouds of different counts stay comparable.
 *
 * \param[in] cloud at least three points
 * \throws std::invalid_argument where the points coincide or lie on a line, so that no
 * rotation is determined
 */
PreShape
toPreShape(const LocalCloud& cloud);

/** \brief The same cloud with another size: where the scale of a pair is known, the
 * source takes its size from the target's.
 */
PreShape
withSize(const PreShape& shape, double size);

} // namespace kss
} // namespace pcl
