/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/detail/points.h>

#include "candidates/numbers.h"

#include <array>
#include <vector>

namespace pcl {
namespace kss {

/** \brief The candidate centres {C}: a grid around the centre of a cloud. */
struct CandidateCenters {
  /** \brief The centres; the third axis varies fastest. */
  std::vector<Eigen::Vector3d> centers;
  /** \brief Their number along each axis of the grid. */
  std::array<int, 3> steps;
  /** \brief The axes of the grid, columns of unit length. */
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  /** \brief The distance of adjacent centres along each axis. */
  Eigen::Array3d spacing = Eigen::Array3d::Zero();
};

/** \brief The centre of the cloud alone: both clouds are complete. */
CandidateCenters
ownCenter();

/** \brief {C} of (e123): 5 x 5 x 5 centres in the local frame of the incomplete cloud.
 *
 * The Y axis points to the point farthest from the centre, Z is normal to it and to the
 * point nearest to the centre, X to both. The steps are r_s / 2, and r_s is a quarter
 * of the distance of the farthest point.
 * \param[in] cloud a pre-shape: centred, its points not on a line
 */
CandidateCenters
paperCenters(const Points& cloud);

/** \brief A box along the principal axes of a cloud.
 *
 * If a body of even cross-section lacks half of itself, the centre of the rest lies
 * 0.87 standard deviations off along the axis that is cut; the centres of two parts can
 * lie twice as far apart.
 * \param[in] cloud a pre-shape
 * \param[in] reach how far the box reaches, in standard deviations along each axis
 * \param[in] step the largest distance of adjacent centres, unless more than \a most
 * centres would be needed
 * \param[in] most how many there may be
 */
CandidateCenters
spreadCenters(const Points& cloud,
              double reach,
              double step,
              double most = search_numbers::most_centers);

} // namespace kss
} // namespace pcl
