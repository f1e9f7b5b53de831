/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "clouds.h"

/** What every method needs that matches points by how their surroundings look. */
namespace benchmarks {

using Normals = pcl::PointCloud<pcl::Normal>;
using Feature = pcl::FPFHSignature33;
using Features = pcl::PointCloud<Feature>;

/** \brief A thinned cloud with a description of every point. */
struct Described {
  Cloud::Ptr points{new Cloud};
  Normals::Ptr normals{new Normals};
  Features::Ptr features{new Features};
};

/** \brief First: one point for each occupied cell of a grid.
 * \param[in] leaf length of a cell's edges
 */
void
thin(const Cloud::ConstPtr& cloud, float leaf, Described& result);

/** \brief Second: normals. Seen from the middle, those of both clouds point to the same
 * side.
 */
void
estimateNormals(float radius, Described& cloud);

/** \brief Third: fast point feature histograms. */
void
describe(float radius, Described& cloud);

} // namespace benchmarks
