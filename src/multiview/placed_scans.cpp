/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "multiview/placed_scans.h"

#include <algorithm>

namespace pcl {
namespace kss {
namespace {

/** A pose that is kept is off by no more than this share of the radius. */
constexpr double kept_share = 0.05;

} // namespace

Eigen::Matrix4d
PlacedScans::relativePose(std::size_t source, std::size_t target) const
{
  return inverted(poses[target]) * Eigen::Matrix4d(poses[source]);
}

double
PlacedScans::deviationOf(std::size_t source,
                         std::size_t target,
                         const StoredPose& pose) const
{
  return displacement(descriptions[source], relativePose(source, target), pose);
}

ExpectedOverlap
PlacedScans::overlapOf(std::size_t source, std::size_t target) const
{
  return expectedOverlap(descriptions[source], descriptions[target],
                         relativePose(source, target));
}

NearestPose
PlacedScans::nearestPose(const PairResult& pair) const
{
  NearestPose nearest;
  for (std::size_t i = 0; i < pair.poses.size(); ++i) {
    const double deviation =
        deviationOf(pair.source, pair.target, pair.poses[i].transformation);
    if (deviation < nearest.deviation)
      nearest = {i, deviation};
  }
  return nearest;
}

bool
PlacedScans::isKept(const PairResult& pair) const
{
  return nearestPose(pair).deviation <=
         kept_share * smallerRadius(pair.source, pair.target);
}

double
PlacedScans::smallerRadius(std::size_t a, std::size_t b) const
{
  return std::min(radiusOf(descriptions[a]), radiusOf(descriptions[b]));
}

std::vector<PlacedScan>
PlacedScans::members(const PlacedGroup& group) const
{
  std::vector<PlacedScan> scans;
  for (const std::size_t scan : group)
    scans.push_back({scan, poses[scan]});
  return scans;
}

} // namespace kss
} // namespace pcl
