/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "evaluation_models.h"

#include "case.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

/** What the tests of the evaluation's cases share. */
namespace kss_test {

/** \brief The surface of a mesh that has been written to a file. */
inline evaluation::Surface
surfaceOf(const Folder& folder, const Mesh& mesh)
{
  return evaluation::Surface(folder.write("model.off", offOf(mesh)));
}

/** \brief A condition by its name, with so many points. */
inline evaluation::Condition
conditionOf(const std::string& name, std::size_t points, evaluation::Protocol protocol)
{
  protocol.points = points;
  for (const auto& condition :
       evaluation::conditionsOf(evaluation::tableNames(), protocol))
    if (condition.name == name)
      return condition;
  throw std::runtime_error("no condition " + name);
}

/** \brief Where the truth places the source's points, in double precision. */
inline std::vector<Eigen::Vector3d>
placedSource(const evaluation::Case& work)
{
  std::vector<Eigen::Vector3d> points;
  for (const auto& point : *work.source)
    points.push_back(
        (work.truth * point.getVector3fMap().cast<double>().homogeneous()).head<3>());
  return points;
}

inline std::vector<Eigen::Vector3d>
positionsOf(const evaluation::Cloud& cloud)
{
  std::vector<Eigen::Vector3d> points;
  for (const auto& point : cloud)
    points.push_back(point.getVector3fMap().cast<double>());
  return points;
}

/** \brief How far a point is from the nearest of others, each compared with it. */
inline double
distanceToNearest(const Eigen::Vector3d& point,
                  const std::vector<Eigen::Vector3d>& others)
{
  double least = std::numeric_limits<double>::max();
  for (const auto& other : others)
    least = std::min(least, (other - point).squaredNorm());
  return std::sqrt(least);
}

/** \brief Whether a rotation is one about x, then y, then z, each by more than some
 * degrees: there are two ways to take it apart. */
inline bool
turnsAboutEachAxisBy(double degrees, const Eigen::Matrix3d& r)
{
  const double y = std::asin(std::clamp(-r(2, 0), -1.0, 1.0));
  const double x = std::atan2(r(2, 1), r(2, 2)), z = std::atan2(r(1, 0), r(0, 0));
  const auto allLarge = [&](const std::array<double, 3>& angles) {
    return std::all_of(angles.begin(), angles.end(), [&](double angle) {
      return std::abs(std::remainder(angle, 2.0 * M_PI)) * 180.0 / M_PI >
             degrees - 1e-6;
    });
  };
  return allLarge({x, y, z}) || allLarge({x + M_PI, M_PI - y, z + M_PI});
}

} // namespace kss_test
