/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/common/transforms.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>
#include <random>
#include <vector>

/** A scanner that sees what is in front of it, and nothing behind: for the examples
 * with many scans. */
namespace example {

using Cloud = pcl::PointCloud<pcl::PointXYZ>;

/** A scan in a frame of its own, and where that frame really is. */
struct Scan {
  Cloud::Ptr cloud;
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
};

/** What a scanner measures: how many directions of what view, and how far. */
struct Scanner {
  int columns = 360, rows = 100;
  float width = 360.0f, lowest = -60.0f, highest = 60.0f; ///< degrees
  float range = 20.0f, noise = 0.002f;
};

/** Boxes along the axes that stand for walls, furniture, houses and cars. */
class Boxes {
public:
  void
  add(const Eigen::Vector3f& smallest, const Eigen::Vector3f& largest)
  {
    boxes_.emplace_back(smallest, largest);
  }

  /** How far it is from a point to the nearest box in a direction. */
  float
  distance(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction) const
  {
    float nearest = std::numeric_limits<float>::infinity();
    for (const Eigen::AlignedBox3f& box : boxes_) {
      const Eigen::Array3f a = (box.min() - origin).array() / direction.array();
      const Eigen::Array3f b = (box.max() - origin).array() / direction.array();
      const float enters = a.min(b).maxCoeff(), leaves = a.max(b).minCoeff();
      if (enters > 0.0f && enters <= leaves)
        nearest = std::min(nearest, enters);
    }
    return nearest;
  }

private:
  std::vector<Eigen::AlignedBox3f> boxes_;
};

/** Scan what distance(origin, direction) measures. The scanner looks along its x axis;
 * the scan is then turned any way and moved, so that nothing tells where it was made.
 */
template <typename Distance>
Scan
scanFrom(const Eigen::Isometry3d& place,
         const Scanner& scanner,
         const Distance& distance,
         unsigned int seed)
{
  std::mt19937 random(seed);
  std::normal_distribution<float> gauss;
  Scan scan;
  scan.cloud.reset(new Cloud);
  const float degree = static_cast<float>(M_PI) / 180.0f;
  for (int column = 0; column < scanner.columns; ++column)
    for (int row = 0; row < scanner.rows; ++row) {
      const float aside = degree * scanner.width * (column + 0.5f) / scanner.columns -
                          degree * scanner.width / 2.0f;
      const float up = degree * (scanner.lowest + (scanner.highest - scanner.lowest) *
                                                      (row + 0.5f) / scanner.rows);
      const Eigen::Vector3f direction(std::cos(up) * std::cos(aside),
                                      std::cos(up) * std::sin(aside), std::sin(up));
      const float range = distance(place.translation().cast<float>(),
                                   place.linear().cast<float>() * direction);
      if (range > scanner.range)
        continue;
      pcl::PointXYZ point;
      point.getVector3fMap() = (range + scanner.noise * gauss(random)) * direction;
      scan.cloud->push_back(point);
    }

  const double w = gauss(random), x = gauss(random), y = gauss(random),
               z = gauss(random);
  Eigen::Isometry3d frame =
      Eigen::Translation3d(x, y, z) * Eigen::Quaterniond(w, x, y, z).normalized();
  pcl::transformPointCloud(*scan.cloud, *scan.cloud, frame.matrix().cast<float>());
  scan.pose = place * frame.inverse();
  return scan;
}

/** How far a pose puts a scan from where another one puts it: root mean square over its
 * points. */
inline double
misplacement(const Cloud& cloud,
             const Eigen::Isometry3d& pose,
             const Eigen::Isometry3d& truth)
{
  double sum = 0.0;
  for (const pcl::PointXYZ& point : cloud) {
    const Eigen::Vector3d place = point.getVector3fMap().cast<double>();
    sum += (pose * place - truth * place).squaredNorm();
  }
  return std::sqrt(sum / cloud.size());
}

/** Whether all scans are in one group, each where it really is up to a tolerance; what
 * is found is printed. */
template <typename Multiview>
bool
areInPlace(const Multiview& multiview, const std::vector<Scan>& scans, double tolerance)
{
  const auto groups = multiview.getGroups();
  std::cout << scans.size() << " scans in " << groups.size() << " group(s)\n";
  if (groups.size() != 1)
    return false;
  // the frame of a group is that of its first scan
  const Eigen::Isometry3d to_first = scans[groups[0].front()].pose.inverse();
  double largest = 0.0;
  for (const std::size_t i : groups[0]) {
    const double error =
        misplacement(*scans[i].cloud, Eigen::Isometry3d(multiview.getPose(i)),
                     to_first * scans[i].pose);
    std::cout << "scan " << i << " is misplaced by " << error << '\n';
    largest = std::max(largest, error);
  }
  return largest < tolerance;
}

} // namespace example
