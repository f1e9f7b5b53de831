/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "scans.h"

#include "places.h"
#include "scanners.h"

#include <pcl/common/transforms.h>

#include <cmath>
#include <map>
#include <random>

namespace benchmarks {
namespace {

constexpr double degree = M_PI / 180.0;

/** \brief The source in a frame that tells nothing: turned by 140 degrees about any
 * axis, and moved.
 */
Pair
makePair(const Cloud::Ptr& source,
         const Eigen::Isometry3d& source_frame,
         const Cloud::Ptr& target,
         const Eigen::Isometry3d& target_frame,
         unsigned int seed)
{
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  const double x = normal(random), y = normal(random), z = normal(random);
  const Eigen::Affine3d away =
      Eigen::Translation3d(30.0, -20.0, 10.0) *
      Eigen::AngleAxisd(140.0 * degree, Eigen::Vector3d(x, y, z).normalized());
  pcl::transformPointCloud(*source, *source, away.cast<float>());
  return {source, target,
          Eigen::Affine3d(target_frame.inverse() * source_frame) * away.inverse()};
}

Pair
makeStreetPair(unsigned int seed)
{
  const Eigen::Isometry3d first =
      Eigen::Translation3d(-3.0, -1.6, 1.9) *
      Eigen::AngleAxisd(0.4 * degree, Eigen::Vector3d::UnitY());
  const Eigen::Isometry3d second =
      Eigen::Translation3d(3.0, -1.2, 1.9) *
      Eigen::AngleAxisd(7.0 * degree, Eigen::Vector3d::UnitZ());
  return makePair(sweep(street(seed, -11.0), second, 2 * seed + 1), second,
                  sweep(street(seed, 9.0), first, 2 * seed), first, seed);
}

Pair
makeRoomPair(unsigned int seed)
{
  const Place place = room(seed);
  const Eigen::Isometry3d first = lookAt({4.6, 0.5, 1.5}, {1.6, 2.7, 0.8});
  const Eigen::Isometry3d second = lookAt({4.8, 1.7, 1.4}, {2.1, 4.0, 0.8});
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
