/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "preparation/given_normals.h"

#include "geometry/sides.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>

namespace pcl {
namespace kss {
namespace {

/** The mean cosine, signs aside, between normals given and found that speaks for those
 * given: chance makes a half. */
constexpr double similar = 0.65;

using Place = std::array<float, 3>;

Place
placeOf(const Points& points, Eigen::Index i)
{
  return {points(0, i), points(1, i), points(2, i)};
}

struct HashOfPlace {
  std::size_t
  operator()(const Place& place) const
  {
    std::size_t hash = 0;
    for (const float coordinate : place)
      hash = hash * 1000003 + std::hash<float>()(coordinate);
    return hash;
  }
};

/** The normals that came with some of the points; zero where they have none. */
Points
givenAt(const Points& some, const LocalCloud& cloud)
{
  std::unordered_map<Place, Eigen::Index, HashOfPlace> number(some.cols());
  for (Eigen::Index i = 0; i < some.cols(); ++i)
    number.emplace(placeOf(some, i), i);
  Points given = Points::Zero(3, some.cols());
  for (Eigen::Index i = 0; i < cloud.points.cols(); ++i) {
    const auto found = number.find(placeOf(cloud.points, i));
    if (found != number.end() && given.col(found->second).isZero())
      given.col(found->second) = cloud.normals.col(i);
  }
  return given;
}

/** Whether most points have normals, and these are of that surface. */
bool
areNormalsOf(const Points& given, const Points& found)
{
  double sum = 0.0;
  Eigen::Index known = 0;
  for (Eigen::Index i = 0; i < given.cols(); ++i)
    if (!given.col(i).isZero()) {
      sum += std::abs(given.col(i).dot(found.col(i)));
      ++known;
    }
  return 2 * known > given.cols() && sum >= similar * static_cast<double>(known);
}

/** Turn the normal of a point as that of the nearest neighbour that has one. */
void
turnAsNeighbour(Eigen::Index i,
                const Points& given,
                const Neighbourhoods& neighbourhoods,
                Points& normals)
{
  for (Eigen::Index n = 0; n < neighbourhoods.indices.rows(); ++n) {
    const int other = neighbourhoods.indices(n, i);
    if (given.col(other).isZero())
      continue;
    if (normals.col(i).dot(given.col(other)) < 0.0f)
      normals.col(i) *= -1.0f;
    return;
  }
}

} // namespace

bool
takeGivenNormals(const LocalCloud& cloud, const Surface& surface, Points& normals)
{
  if (cloud.normals.cols() == 0)
    return false;
  const Points given = givenAt(surface.points, cloud);
  if (!areNormalsOf(given, normals))
    return false;
  for (Eigen::Index i = 0; i < given.cols(); ++i)
    if (given.col(i).isZero())
      turnAsNeighbour(i, given, surface.neighbourhoods, normals);
    else
      normals.col(i) = given.col(i);
  return sidesAreConsistent(surface.points, given, surface.neighbourhoods);
}

} // namespace kss
} // namespace pcl
