/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

namespace benchmarks {

/** \brief The diagonal of a cloud's bounding box. */
double
diagonalOf(const pcl::PointCloud<pcl::PointXYZ>& cloud);

} // namespace benchmarks
