/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/scan_work.h>

#include "multiview/candidates_of_pairs.h"
#include "multiview/placement_of_scans.h"

#include <Eigen/Geometry>

#include <random>
#include <vector>

namespace made_up {

/** \brief What the registration of two scans may come to: a pose. */
inline pcl::kss::PairResult
resultOf(std::size_t source,
         std::size_t target,
         const Eigen::Matrix4d& pose = Eigen::Matrix4d::Identity())
{
  pcl::kss::PairResult pair;
  pair.source = source;
  pair.target = target;
  pair.poses.resize(1);
  pair.poses.front().transformation = pose;
  return pair;
}

/** \brief Scans whose poses are known, without points. */
class Scans {
public:
  explicit Scans(std::size_t size)
  : descriptions(size)
  {
    for (std::size_t i = 0; i < size; ++i) {
      pcl::kss::ScanDescription& scan = descriptions[i];
      scan.centroid = Eigen::Vector3d(1.0, 2.0, 3.0 + i);
      scan.spread = Eigen::Vector3d(4.0, 2.0, 1.0).asDiagonal();
      scan.spacing = 0.05;
      std::normal_distribution<float> normal;
      for (int p = 0; p < 100; ++p)
        scan.outline.emplace_back(Eigen::Vector3f::NullaryExpr(
            [&](Eigen::Index) { return normal(random_); }));
      scan.gap = 0.3;
      scan.reach = 4.0;
      poses.push_back(randomPose(20.0));
    }
  }

  /** \brief A random rotation, and a place so far away at most. */
  Eigen::Matrix4d
  randomPose(double reach)
  {
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> uniform(-reach, reach);
    const Eigen::Quaterniond turn(normal(random_), normal(random_), normal(random_),
                                  normal(random_));
    Eigen::Isometry3d pose(turn.normalized());
    for (int i = 0; i < 3; ++i)
      pose.translation()[i] = uniform(random_);
    return pose.matrix();
  }

  /** \brief A pose that is off by so much: radians, and units. */
  Eigen::Matrix4d
  disturbed(const Eigen::Matrix4d& pose, double angle, double shift)
  {
    std::normal_distribution<double> normal;
    const auto vector = [&] {
      return Eigen::Vector3d(normal(random_), normal(random_), normal(random_));
    };
    Eigen::Isometry3d error(Eigen::AngleAxisd(angle, vector().normalized()));
    error.pretranslate(shift * vector().normalized());
    return pose * error.matrix();
  }

  /** \brief Where a scan is in another one. */
  Eigen::Matrix4d
  relative(std::size_t source, std::size_t target) const
  {
    return pcl::kss::inverted(poses[target]) * poses[source];
  }

  /** \brief Add a pose of a pair of its own that may be right. */
  void
  add(std::size_t source,
      std::size_t target,
      const Eigen::Matrix4d& pose,
      double probability)
  {
    candidates.push_back({pairs++, 0, source, target, pose, probability});
  }

  /** \brief How far a pose places a scan of a group from where it is, the first one of
   * the group being where it is. */
  double
  error(std::size_t first,
        std::size_t scan,
        const std::vector<pcl::kss::StoredPose>& found) const
  {
    return pcl::kss::displacement(descriptions[scan],
                                  pcl::kss::inverted(found[first]) * found[scan],
                                  relative(scan, first));
  }

  std::vector<pcl::kss::ScanDescription> descriptions;
  std::vector<Eigen::Matrix4d> poses; ///< to the world
  std::vector<pcl::kss::PoseCandidate> candidates;
  std::size_t pairs = 0;

private:
  std::mt19937 random_{1};
};

} // namespace made_up
