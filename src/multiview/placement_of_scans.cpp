/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "multiview/placement_of_scans.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace pcl {
namespace kss {
namespace {

/** The squared distance of each point from the nearest of others.
 * \param[in] are_same whether a point is no neighbour of itself */
Eigen::VectorXf
squaredDistances(const Eigen::Matrix3Xf& from,
                 const Eigen::Matrix3Xf& to,
                 bool are_same)
{
  Eigen::VectorXf squared(from.cols());
  for (Eigen::Index i = 0; i < from.cols(); ++i) {
    Eigen::RowVectorXf all = (to.colwise() - from.col(i)).colwise().squaredNorm();
    if (are_same)
      all[i] = std::numeric_limits<float>::infinity();
    squared[i] = all.minCoeff();
  }
  return squared;
}

/** Points in farthest order are about that far apart, squared. */
float
squaredGap(const Eigen::Matrix3Xf& outline)
{
  const Eigen::VectorXf squared = squaredDistances(outline, outline, true);
  std::vector<float> sorted(squared.data(), squared.data() + squared.size());
  std::nth_element(sorted.begin(), sorted.begin() + sorted.size() / 2, sorted.end());
  return sorted[sorted.size() / 2];
}

/** The share of points that others cover; no farther away than they are apart. */
double
covered(const Eigen::Matrix3Xf& points, const Eigen::Matrix3Xf& others)
{
  const float gap = squaredGap(others);
  return (squaredDistances(points, others, false).array() <= gap).cast<double>().mean();
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

double
expectedOverlap(const ScanDescription& source,
                const ScanDescription& target,
                const Eigen::Matrix4d& pose)
{
  // relative to the target's centroid, where floats are fine
  const Eigen::Matrix3d rotation = pose.topLeftCorner<3, 3>();
  const Eigen::Vector3d shift =
      (pose * source.centroid.homogeneous()).head<3>() - target.centroid;
  const Eigen::Matrix3Xf placed =
      (rotation.cast<float>() * source.outline).colwise() + shift.cast<float>();
  return std::max(covered(placed, target.outline), covered(target.outline, placed));
}

} // namespace kss
} // namespace pcl
