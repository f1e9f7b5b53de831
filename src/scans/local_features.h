/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/detail/points.h>

#include <Eigen/Core>

#include <vector>

namespace pcl {
namespace kss {

/** \brief What a surface is like around points of it, however it is turned: how often
 * its points around one of them lie in which direction, seen from its normal, with a
 * normal at which angle, and how far away (after the histograms of E. Wahl, U.
 * Hillenbrand, G. Hirzinger, "Surflet-pair-relation histograms", 2003, and R. B. Rusu,
 * N. Blodow, M. Beetz, "Fast point feature histograms", 2009; signs of normals mean
 * nothing here).
 * \param[in] points of the surface
 * \param[in] normals of them, of unit length and either sign
 * \param[in] chosen the indices of the points that are described
 * \param[in] reach how far around them
 * \return a column for each, of unit length: the square roots of the shares of the bins
 */
Eigen::MatrixXf
localFeatures(const Points& points,
              const Points& normals,
              const std::vector<int>& chosen,
              float reach);

} // namespace kss
} // namespace pcl
