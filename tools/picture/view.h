/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "io/geometry.h"

#include <Eigen/Core>

namespace tool {

/** \brief How points are looked at: its rows point to the right, up, and towards the
 * viewer.
 *
 * Along the direction in which they extend least, from a little to the right and above.
 * What the file has for up, z or else y, is up in the picture, unless the points are a
 * strip, which lies along it.
 * \param[in] points at least one, all finite
 */
Eigen::Matrix3d
viewOf(const Points& points);

/** \brief The points as a view shows them: to the right, up, and towards the viewer. */
Points
seenFrom(const Eigen::Matrix3d& view, const Points& points);

/** \brief What of a view's plane a panel shows. */
struct Frame {
  /** \brief What is in the middle: to the right, and up. */
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  /** \brief How far what is shown extends. */
  Eigen::Vector2d size = Eigen::Vector2d::Ones();

  /** \brief How many pixels of a panel a unit takes, with some room at the rim. */
  double
  pixelsPerUnit(double width, double height) const;
};

/** \brief Where the points lie, a few that are far out aside.
 * \param[in] seen to the right, up, and towards the viewer; at least one
 */
Frame
frameOf(const Points& seen);

} // namespace tool
