/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "multiview/placement_of_scans.h"

#include <algorithm>
#include <cmath>

namespace pcl {
namespace kss {
namespace {

/** The share of points that have others no farther away than those are apart. */
double
covered(const Eigen::Matrix3Xf& points, const Eigen::Matrix3Xf& others, double gap)
{
  const auto squared = static_cast<float>(gap * gap);
  Eigen::Index count = 0;
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    if ((others.colwise() - points.col(i)).colwise().squaredNorm().minCoeff() <=
        squared)
      ++count;
  return static_cast<double>(count) / static_cast<double>(points.cols());
}

/** The points of a scan's outline as columns. */
Eigen::Map<const Eigen::Matrix3Xf>
outlineOf(const ScanDescription& scan)
{
  return {scan.outline.empty() ? nullptr : scan.outline.front().data(), 3,
          static_cast<Eigen::Index>(scan.outline.size())};
}

} // namespace

double
radiusOf(const ScanDescription& scan)
{
  return std::sqrt(scan.spread.trace());
}

double
displacement(const ScanDescription& scan,
             const Eigen::Matrix4d& a,
             const Eigen::Matrix4d& b)
{
  const Eigen::Matrix<double, 3, 4> apart = (a - b).topRows<3>();
  const Eigen::Matrix3d linear = apart.leftCols<3>();
  const double turned = (linear * scan.spread * linear.transpose()).trace();
  return std::sqrt(std::max(turned, 0.0) +
                   (apart * scan.centroid.homogeneous()).squaredNorm());
}

Eigen::Matrix<double, 6, 6>
informationOfDisplacement(const ScanDescription& scan, const Eigen::Matrix4d& pose)
{
  const Eigen::Matrix3d rotation = pose.topLeftCorner<3, 3>();
  const Eigen::Matrix3d spread = rotation * scan.spread * rotation.transpose();
  Eigen::Matrix<double, 6, 6> information = Eigen::Matrix<double, 6, 6>::Identity();
  information.topLeftCorner<3, 3>() =
      spread.trace() * Eigen::Matrix3d::Identity() - spread;
  return information;
}

ExpectedOverlap
expectedOverlap(const ScanDescription& source,
                const ScanDescription& target,
                const Eigen::Matrix4d& pose)
{
  // relative to the target's centroid, where floats are fine
  const Eigen::Matrix3d rotation = pose.topLeftCorner<3, 3>();
  const Eigen::Vector3d shift =
      (pose * source.centroid.homogeneous()).head<3>() - target.centroid;
  if (shift.norm() > source.reach + target.reach)
    return {};
  const Eigen::Matrix3Xf placed =
      (rotation.cast<float>() * outlineOf(source)).colwise() + shift.cast<float>();
  const double of_source = covered(placed, outlineOf(target), target.gap);
  const double of_target = covered(outlineOf(target), placed, source.gap);
  return {std::max(of_source, of_target), std::min(of_source, of_target)};
}

} // namespace kss
} // namespace pcl
