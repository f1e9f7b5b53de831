/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/detail/points.h>

#include <Eigen/Core>

namespace pcl {
namespace kss {

/** \brief How often pairs of points lie how far apart, and how their normals stand: a
 * description that turning does not change, of what is where along a surface (R. Osada
 * et al., "Shape distributions", 2002, with the angles of E. Wahl, U. Hillenbrand, G.
 * Hirzinger, "Surflet-pair-relation histograms", 2003).
 *
 * A column for each octave of distances, of whatever unit, so that scans that show a
 * part of each other in common have near distances in common; the square roots of the
 * shares of its bins, so that the product of two columns is 1 where they are the same.
 * \param[in] points
 * \param[in] normals of them, of either sign
 */
Eigen::MatrixXf
pairFeatures(const Points& points, const Points& normals);

} // namespace kss
} // namespace pcl
