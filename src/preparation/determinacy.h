/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

namespace pcl {
namespace kss {

/** \brief How large a cloud is, and how fine. */
struct CloudSize {
  /** \brief The longest edge of its bounding box. */
  double extent;
  /** \brief Its root mean square radius. */
  double radius;
  /** \brief The spacing of its points, median. */
  double spacing;
};

/** \brief Whether no cloud is so small, at a scale, that the other covers it wherever a
 * point of the other is.
 *
 * A surface covers what lies within \ref covered spacings of a point of it.
 * \param[in] source the cloud that is placed
 * \param[in] target the cloud it is placed upon
 * \param[in] scale of the source there
 */
bool
isDetermined(const CloudSize& source, const CloudSize& target, double scale);

/** \brief Throw where a cloud covers itself at any pose, since its points are too few,
 * or one covers the other: see isDetermined().
 * \throws std::invalid_argument
 */
void
throwIfUndetermined(const CloudSize& source, const CloudSize& target, double scale);

} // namespace kss
} // namespace pcl
