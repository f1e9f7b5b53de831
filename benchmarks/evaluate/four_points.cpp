/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "four_points.h"

#include "described_pair.h"

#include <cmath>

namespace evaluation {
namespace {

/** \brief Thin to at most so many points.
 * \param[in] leaf where to begin
 * \return where it ended
 */
float
thinTo(const Cloud::ConstPtr& cloud,
       std::size_t points,
       float leaf,
       benchmarks::Described& result)
{
  benchmarks::thin(cloud, leaf, result);
  while (result.points->size() > points) {
    leaf *= 1.1f;
    benchmarks::thin(cloud, leaf, result);
  }
  return leaf;
}

} // namespace

FourPointsPair::FourPointsPair(const CentredPair& pair, std::size_t points)
{
  const float smallest = leafFor(pair);
  leaf = thinTo(pair.source, points, smallest, source);
  thinTo(pair.target, 5 * points, 0.5f * smallest, target);
  benchmarks::estimateNormals(2.0f * smallest, source);
  benchmarks::estimateNormals(2.0f * smallest, target);
}

int
trialsFor(double overlap)
{
  return std::clamp(static_cast<int>(20.0 / std::pow(overlap, 4)), 20, 600);
}

} // namespace evaluation
