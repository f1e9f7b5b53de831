/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "scanners.h"

#include <cmath>
#include <random>

namespace benchmarks {
namespace {

constexpr double degree = M_PI / 180.0;

/** \brief What a scanner that spins about its z axis can see in one direction. */
Place
columnOf(const Place& place, const Eigen::Isometry3d& scanner, double azimuth)
{
  const Eigen::Vector3d ahead(std::cos(azimuth), std::sin(azimuth), 0.0);
  const Eigen::Vector3d aside(-ahead.y(), ahead.x(), 0.0);
  return place.slice({scanner.translation(), scanner.linear() * ahead},
                     scanner.linear() * aside);
}

} // namespace

Cloud::Ptr
sweep(const Place& place, const Eigen::Isometry3d& scanner, unsigned int seed)
{
  std::mt19937 random(seed);
  std::normal_distribution<double> range_noise(0.0, 0.02), roughness(0.0, 0.005);
  std::uniform_real_distribution<double> luck;
  Cloud::Ptr cloud(new Cloud);
  const int rings = 32, columns = 870;
  for (int column = 0; column < columns; ++column) {
    const double azimuth = 2.0 * M_PI * column / columns;
    const Place ahead = columnOf(place, scanner, azimuth);
    for (int ring = 0; ring < rings; ++ring) {
      const double elevation = (-25.0 + 40.0 * ring / (rings - 1)) * degree;
      const Eigen::Vector3d direction(std::cos(elevation) * std::cos(azimuth),
                                      std::cos(elevation) * std::sin(azimuth),
                                      std::sin(elevation));
      const double range =
          ahead.distance({scanner.translation(), scanner.linear() * direction});
      // not every pulse comes back
      if (range > 70.0 || range < 1.0 || luck(random) < 0.03)
        continue;
      Eigen::Vector3d point = (range + range_noise(random)) * direction;
      for (int axis = 0; axis < 3; ++axis)
        point[axis] += roughness(random);
      cloud->emplace_back(point.x(), point.y(), point.z());
    }
  }
  return cloud;
}

Cloud::Ptr
photograph(const Place& place,
           const Eigen::Isometry3d& camera,
           unsigned int seed,
           int step)
{
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> luck;
  Cloud::Ptr cloud(new Cloud);
  const int width = 640, height = 480;
  const double focal_length = 460.0; // pixels: 70 by 55 degrees
  for (int v = 0; v < height; v += step)
    for (int u = 0; u < width; u += step) {
      const Eigen::Vector3d sight((u + 0.5 - width / 2.0) / focal_length,
                                  (v + 0.5 - height / 2.0) / focal_length, 1.0);
      const double range =
          place.distance({camera.translation(), camera.linear() * sight.normalized()});
      const double exact = range / sight.norm();
      if (exact > 6.0 || exact < 0.3 || luck(random) < 0.02)
        continue;
      const double depth = exact + 0.0015 * exact * exact * normal(random);
      const Eigen::Vector3d point = depth * sight;
      cloud->emplace_back(point.x(), point.y(), point.z());
    }
  return cloud;
}

Cloud::Ptr
panorama(const Place& place, const Eigen::Isometry3d& scanner, unsigned int seed)
{
  std::mt19937 random(seed);
  std::normal_distribution<double> range_noise(0.0, 0.002);
  Cloud::Ptr cloud(new Cloud);
  const int rows = 200, columns = 500; // 0.72 degrees either way
  for (int column = 0; column < columns; ++column) {
    const double azimuth = 2.0 * M_PI * column / columns;
    const Place ahead = columnOf(place, scanner, azimuth);
    for (int row = 0; row < rows; ++row) {
      const double elevation = (-60.0 + 144.0 * row / rows) * degree;
      const Eigen::Vector3d direction(std::cos(elevation) * std::cos(azimuth),
                                      std::cos(elevation) * std::sin(azimuth),
                                      std::sin(elevation));
      const double range =
          ahead.distance({scanner.translation(), scanner.linear() * direction});
      if (range > 20.0 || range < 0.4)
        continue;
      const Eigen::Vector3d point = (range + range_noise(random)) * direction;
      cloud->emplace_back(point.x(), point.y(), point.z());
    }
  }
  return cloud;
}

Eigen::Isometry3d
lookAt(const Eigen::Vector3d& eye, const Eigen::Vector3d& goal)
{
  const Eigen::Vector3d ahead = (goal - eye).normalized();
  const Eigen::Vector3d right = ahead.cross(Eigen::Vector3d::UnitZ()).normalized();
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() << right, ahead.cross(right), ahead;
  pose.translation() = eye;
  return pose;
}

} // namespace benchmarks
