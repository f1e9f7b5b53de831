/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <random>
#include <string>

/** Random numbers that follow from names and a seed alone: on every machine, with every
 * standard library, in whatever order cases are made.
 */
namespace evaluation {

using Random = std::mt19937_64;

/** \brief A number that tells names apart (FNV-1a). */
std::uint64_t
hashOf(const std::string& names);

/** \brief The generator for what has this name. */
inline Random
randomFor(const std::string& names)
{
  return Random(hashOf(names));
}

/** \brief A number from an interval, all of it equally likely. */
double
uniform(Random& random, double smallest, double largest);

/** \brief A number from the standard normal distribution. */
double
gaussian(Random& random);

/** \brief A unit vector, all directions equally likely. */
Eigen::Vector3d
direction(Random& random);

/** \brief A rotation, all of SO(3) equally likely. */
Eigen::Matrix3d
rotation(Random& random);

/** \brief A rotation about x, then y, then z, each by more than \a least radians to
 * either side.
 */
Eigen::Matrix3d
rotationAboutAxes(Random& random, double least);

} // namespace evaluation
