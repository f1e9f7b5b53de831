/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "geometry/pose_metric.h"

#include <Eigen/Cholesky>

namespace pcl {
namespace kss {

PoseMetric::PoseMetric(const Points& cloud)
{
  const Eigen::Matrix3f scatter = cloud * cloud.transpose() / cloud.cols();
  // a little more than nothing, so that the factor of a plane's exists
  const Eigen::Matrix3f some = 1e-6f * scatter.trace() * Eigen::Matrix3f::Identity();
  spread_ = (scatter + some).llt().matrixL();
}

PoseMetric::Place
PoseMetric::placeOf(const Similarity& pose) const
{
  Eigen::Matrix<float, 3, 4> place = pose.placement();
  place.leftCols<3>() *= spread_;
  return Eigen::Map<const Place>(place.data());
}

double
PoseMetric::distance(const Similarity& a, const Similarity& b) const
{
  return (placeOf(a) - placeOf(b)).norm();
}

} // namespace kss
} // namespace pcl
