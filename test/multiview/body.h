/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <Eigen/Geometry>

#include <cmath>
#include <random>
#include <vector>

namespace made_up {

/** \brief A body with bumps, as it is seen from some sides, each time by other points.
 */
class Body {
public:
  explicit Body(unsigned int seed)
  : random_(seed)
  {
    for (int i = 0; i < 12; ++i)
      bumps_.push_back({direction(), uniform(0.2, 0.7), uniform(5.0, 20.0)});
  }

  /** \brief The side that faces a direction, in the frame of a scanner. */
  Eigen::Matrix3Xd
  seenFrom(const Eigen::Vector3d& eye, const Eigen::Matrix4d& T_scan_body, int size)
  {
    Eigen::Matrix3Xd points(3, size);
    for (int i = 0; i < size;) {
      const Eigen::Vector3d at = direction();
      if (at.dot(eye.normalized()) < -0.1)
        continue;
      double radius = 1.0;
      for (const Bump& bump : bumps_)
        radius +=
            bump.height * std::exp(bump.narrowness * (bump.direction.dot(at) - 1.0));
      points.col(i++) = (T_scan_body * (radius * at).homogeneous()).head<3>();
    }
    return points;
  }

  Eigen::Matrix4d
  randomPose()
  {
    Eigen::Isometry3d pose(
        Eigen::Quaterniond(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1), 0.5)
            .normalized());
    pose.translation() = 3.0 * direction();
    return pose.matrix();
  }

private:
  struct Bump {
    Eigen::Vector3d direction;
    double height, narrowness;
  };

  double
  uniform(double smallest, double largest)
  {
    return std::uniform_real_distribution<double>(smallest, largest)(random_);
  }

  Eigen::Vector3d
  direction()
  {
    std::normal_distribution<double> normal;
    const double x = normal(random_), y = normal(random_), z = normal(random_);
    return Eigen::Vector3d(x, y, z).normalized();
  }

  std::mt19937 random_;
  std::vector<Bump> bumps_;
};

/** \brief A scan, and where it is. */
struct BodyScan {
  Eigen::Matrix4d T_scan_body;
  Eigen::Matrix3Xd points;
};

/** \brief Scans of two bodies: three of the one and two of the other. */
inline std::vector<BodyScan>
scansOfTwoBodies(int size)
{
  Body one(1), other(2);
  std::vector<BodyScan> scans;
  for (int i = 0; i < 5; ++i) {
    Body& body = i < 3 ? one : other;
    const double angle = (i < 3 ? i : i - 3) * 2.0 * M_PI / 5.0;
    const Eigen::Matrix4d pose = body.randomPose();
    scans.push_back(
        {pose, body.seenFrom({std::cos(angle), std::sin(angle), 0.3}, pose, size)});
  }
  return scans;
}

} // namespace made_up
