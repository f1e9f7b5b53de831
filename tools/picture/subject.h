/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "io/geometry.h"

#include <string>

namespace tool {

/** \brief A file as people are shown it. */
struct Subject {
  /** \brief Its name, and how many points or faces it has: "scan.ply, 1,000 points". */
  std::string title;
  /** \brief All finite points, at least one; those of a mesh are spread over its faces.
   */
  Points points;
};

/** \brief So many points are drawn of a cloud at most. */
constexpr std::size_t DRAWN_POINTS = 150000;

/** \brief What is drawn of a file.
 * \param[in] path may have folders, which the title does without
 * \param[in] seed of the points spread over a mesh: two of them that had the same would
 * seem to lie on each other more closely than their surfaces do
 */
Subject
subjectOf(const std::string& path, const Geometry& geometry, unsigned int seed);

/** \brief DRAWN_POINTS of them at most, spread over all. */
Points
drawnOf(const Points& points);

/** \brief Points where a transformation puts them. */
Points
moved(const Points& points, const Eigen::Matrix4d& transformation);

} // namespace tool
