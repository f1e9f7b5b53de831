/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "geometry/sides.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace pcl {
namespace kss {
namespace {

/** The share of the square root of the number of points by which neighbours may
 * contradict each other: half of what the silhouette of a ball makes. */
constexpr double allowed = 0.5;

/** Neighbours that a point is compared with: those around it, and no second ring. */
constexpr Eigen::Index compared = 6;

/** Normals with a larger cosine belong to one sheet, or to two that are parallel. */
constexpr float nearly_parallel = 0.7f;

/** A neighbour that lies so far off the plane of a point, in their distance, is on a
 * known side of it. */
constexpr float clearly_off = 0.2f;

/** The share of neighbours on one sheet that lie no farther apart across it than
 * counts as one sheet. */
constexpr double usual = 0.9;

/** Where neighbours on one sheet lie farther apart across it, in their distance, noise
 * hides whether it is one sheet or two. */
constexpr float thin = 0.4f;

/** Less than what single precision leaves of an offset. */
constexpr float rounding = 1e-3f;

/** What a pair of neighbours says of their signs. */
struct Pair {
  float cosine;        ///< of their normals
  float first, second; ///< how far each lies before the other's plane
};

Pair
pairOf(const Points& points, const Points& normals, Eigen::Index i, Eigen::Index j)
{
  const Eigen::Vector3f way = (points.col(j) - points.col(i)).normalized();
  return {normals.col(i).dot(normals.col(j)), normals.col(i).dot(way),
          -normals.col(j).dot(way)};
}

/** How far apart two neighbours of parallel normals are across them: nothing, to the
 * second order, where one sheet bends from one to the other. */
float
gapOf(const Pair& pair)
{
  return 0.5f * std::abs(pair.cosine > 0.0f ? pair.first - pair.second
                                            : pair.first + pair.second);
}

} // namespace

bool
sidesAreConsistent(const Points& points,
                   const Points& normals,
                   const Neighbourhoods& neighbourhoods)
{
  const Eigen::Index size = points.cols();
  const Eigen::Index k = std::min(compared, neighbourhoods.indices.rows());
  std::vector<float> gaps, gaps_of_opposite;
  std::size_t known = 0, edges = 0, contradictions = 0;
  for (Eigen::Index i = 0; i < size; ++i) {
    if (normals.col(i).isZero())
      continue;
    ++known;
    for (Eigen::Index n = 0; n < k; ++n) {
      const int j = neighbourhoods.indices(n, i);
      if (normals.col(j).isZero())
        continue;
      const Pair pair = pairOf(points, normals, i, j);
      if (std::abs(pair.cosine) > nearly_parallel)
        (pair.cosine > 0.0f ? gaps : gaps_of_opposite).push_back(gapOf(pair));
      else if (std::min(std::abs(pair.first), std::abs(pair.second)) > clearly_off) {
        // round an edge, both lie behind the other's plane, or both before it
        ++edges;
        contradictions += pair.first * pair.second < 0.0f;
      }
    }
  }
  if (gaps.empty())
    return false;
  // opposite normals are of one sheet, unless they are the two skins of a wall
  const auto sheet = gaps.begin() + static_cast<std::ptrdiff_t>(usual * gaps.size());
  std::nth_element(gaps.begin(), sheet, gaps.end());
  if (*sheet > thin)
    return false;
  const float thickness = std::max(rounding, *sheet);
  std::size_t telling = gaps.size() + edges;
  for (const float gap : gaps_of_opposite)
    if (gap <= thickness) {
      ++telling;
      ++contradictions;
    }
  return static_cast<double>(contradictions) <=
         allowed * static_cast<double>(telling) / std::sqrt(static_cast<double>(known));
}

} // namespace kss
} // namespace pcl
