/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "model.h"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace tool {

/** \brief A rectangle of the drawing that holds a group. */
struct GroupCell {
  double x, y, width, height;
  std::string title;
};

/** \brief Where scans are in the drawing of a graph. */
struct GraphLayout {
  double width = 0.0, height = 0.0, radius = 0.0; ///< of the drawing, and of a scan
  std::vector<Eigen::Vector2d> places;            ///< of all scans
  std::vector<GroupCell> cells;
};

/** \brief Place scans: those of a group as their centroids lie in its frame, seen along
 * the direction in which they differ least, and moved apart where they would hide one
 * another; the groups beside one another, the largest first.
 */
GraphLayout
layOut(const Model& model, double width);

} // namespace tool
