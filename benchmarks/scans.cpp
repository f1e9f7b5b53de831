/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "scans.h"

#include "places.h"

#include <pcl/common/transforms.h>

#include <cmath>
#include <map>
#include <random>

namespace benchmarks {
namespace {

constexpr double degree = M_PI / 180.0;

/** \brief One sweep over 32 rings, in the frame of the scanner. */
Cloud::Ptr
sweep(const Place& place, const Eigen::Affine3d& scanner, unsigned int seed)
{
  std::mt19937 random(seed);
  std::normal_distribution<double> range_noise(0.0, 0.02), roughness(0.0, 0.005);
  std::uniform_real_distribution<double> luck;
  Cloud::Ptr cloud(new Cloud);
  const int rings = 32, columns = 870;
  for (int column = 0; column < columns; ++column)
    for (int ring = 0; ring < rings; ++ring) {
      const double azimuth = 2.0 * M_PI * column / columns;
      const double elevation = (-25.0 + 40.0 * ring / (rings - 1)) * degree;
      const Eigen::Vector3d direction(std::cos(elevation) * std::cos(azimuth),
                                      std::cos(elevation) * std::sin(azimuth),
                                      std::sin(elevation));
      const double range =
          place.distance({scanner.translation(), scanner.linear() * direction});
      // not every pulse comes back
      if (range > 70.0 || range < 1.0 || luck(random) < 0.03)
        continue;
      Eigen::Vector3d point = (range + range_noise(random)) * direction;
      for (int axis = 0; axis < 3; ++axis)
        point[axis] += roughness(random);
      cloud->emplace_back(point.x(), point.y(), point.z());
    }
  return cloud;
}

/** \brief One depth image, in the frame of the camera: x to the right, y down. */
Cloud::Ptr
photograph(const Place& place, const Eigen::Affine3d& camera, unsigned int seed)
{
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> luck;
  Cloud::Ptr cloud(new Cloud);
  const int width = 640, height = 480;
  const double focal_length = 460.0; // pixels: 70 by 55 degrees
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u) {
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

/** \brief A camera that looks at something, upright. */
Eigen::Affine3d
lookAt(const Eigen::Vector3d& eye, const Eigen::Vector3d& goal)
{
  const Eigen::Vector3d ahead = (goal - eye).normalized();
  const Eigen::Vector3d right = ahead.cross(Eigen::Vector3d::UnitZ()).normalized();
  Eigen::Affine3d pose = Eigen::Affine3d::Identity();
  pose.linear() << right, ahead.cross(right), ahead;
  pose.translation() = eye;
  return pose;
}

/** \brief The source in a frame that tells nothing: turned by 140 degrees about any
 * axis, and moved.
 */
Pair
makePair(const Cloud::Ptr& source,
         const Eigen::Affine3d& source_frame,
         const Cloud::Ptr& target,
         const Eigen::Affine3d& target_frame,
         unsigned int seed)
{
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  const double x = normal(random), y = normal(random), z = normal(random);
  const Eigen::Affine3d away =
      Eigen::Translation3d(30.0, -20.0, 10.0) *
      Eigen::AngleAxisd(140.0 * degree, Eigen::Vector3d(x, y, z).normalized());
  pcl::transformPointCloud(*source, *source, away.cast<float>());
  return {source, target, target_frame.inverse() * source_frame * away.inverse()};
}

Pair
makeStreetPair(unsigned int seed)
{
  const Eigen::Affine3d first =
      Eigen::Translation3d(-3.0, -1.6, 1.9) *
      Eigen::AngleAxisd(0.4 * degree, Eigen::Vector3d::UnitY());
  const Eigen::Affine3d second =
      Eigen::Translation3d(3.0, -1.2, 1.9) *
      Eigen::AngleAxisd(7.0 * degree, Eigen::Vector3d::UnitZ());
  return makePair(sweep(street(seed, -11.0), second, 2 * seed + 1), second,
                  sweep(street(seed, 9.0), first, 2 * seed), first, seed);
}

Pair
makeRoomPair(unsigned int seed)
{
  const Place place = room(seed);
  const Eigen::Affine3d first = lookAt({4.6, 0.5, 1.5}, {1.6, 2.7, 0.8});
  const Eigen::Affine3d second = lookAt({4.8, 1.7, 1.4}, {2.1, 4.0, 0.8});
  return makePair(photograph(place, second, 2 * seed + 1), second,
                  photograph(place, first, 2 * seed), first, seed);
}

/** \brief Made when it is first asked for. */
const Pair&
kept(std::map<unsigned int, Pair>& pairs, unsigned int seed, Pair (*make)(unsigned int))
{
  const auto found = pairs.find(seed);
  return found != pairs.end() ? found->second : pairs[seed] = make(seed);
}

} // namespace

const Pair&
streetPair(unsigned int seed)
{
  static std::map<unsigned int, Pair> pairs;
  return kept(pairs, seed, makeStreetPair);
}

const Pair&
roomPair(unsigned int seed)
{
  static std::map<unsigned int, Pair> pairs;
  return kept(pairs, seed, makeRoomPair);
}

} // namespace benchmarks
