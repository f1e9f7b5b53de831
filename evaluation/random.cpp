/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "random.h"

#include <boost/random/normal_distribution.hpp>
#include <boost/random/uniform_01.hpp>

#include <Eigen/Geometry>

#include <cmath>

// Boost's distributions are the same everywhere; the standard leaves them open.

namespace evaluation {

std::uint64_t
hashOf(const std::string& names)
{
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const unsigned char byte : names)
    hash = (hash ^ byte) * 0x100000001b3;
  return hash;
}

double
uniform(Random& random, double smallest, double largest)
{
  return smallest + (largest - smallest) * boost::random::uniform_01<double>()(random);
}

double
gaussian(Random& random)
{
  return boost::random::normal_distribution<double>()(random);
}

Eigen::Vector3d
direction(Random& random)
{
  const double x = gaussian(random), y = gaussian(random), z = gaussian(random);
  return Eigen::Vector3d(x, y, z).normalized();
}

Eigen::Matrix3d
rotation(Random& random)
{
  const double w = gaussian(random), x = gaussian(random), y = gaussian(random),
               z = gaussian(random);
  return Eigen::Quaterniond(w, x, y, z).normalized().toRotationMatrix();
}

Eigen::Matrix3d
rotationAboutAxes(Random& random, double least)
{
  Eigen::Matrix3d result = Eigen::Matrix3d::Identity();
  for (int axis = 0; axis < 3; ++axis) {
    const double angle = uniform(random, least, 2.0 * M_PI - least);
    result = Eigen::AngleAxisd(angle, Eigen::Vector3d::Unit(axis)) * result;
  }
  return result;
}

} // namespace evaluation
