/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "diagonal.h"

#include <pcl/common/common.h>

namespace benchmarks {

double
diagonalOf(const pcl::PointCloud<pcl::PointXYZ>& cloud)
{
  pcl::PointXYZ smallest, largest;
  pcl::getMinMax3D(cloud, smallest, largest);
  return (largest.getVector3fMap() - smallest.getVector3fMap()).norm();
}

} // namespace benchmarks
