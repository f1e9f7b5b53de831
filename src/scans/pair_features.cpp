/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "scans/pair_features.h"

#include <algorithm>
#include <cmath>

namespace pcl {
namespace kss {
namespace {

/** Distances of any scan, from a millionth of the unit to a million of them. */
constexpr int smallest_octave = -20, octaves = 40;

/** Bins of the distance in an octave, and of each of three cosines in [0, 1]. */
constexpr int distances = 2, cosines = 4;

/** Octaves with fewer pairs than this say nothing. */
constexpr float fewest_pairs = 100.0f;

int
binOf(float cosine)
{
  return std::min(cosines - 1, static_cast<int>(cosines * std::abs(cosine)));
}

} // namespace

Eigen::MatrixXf
pairFeatures(const Points& points, const Points& normals)
{
  Eigen::MatrixXf features =
      Eigen::MatrixXf::Zero(distances * cosines * cosines * cosines, octaves);
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    for (Eigen::Index j = 0; j < i; ++j) {
      const Eigen::Vector3f way = points.col(j) - points.col(i);
      const float length = way.norm();
      if (length <= 0.0f)
        continue;
      const float logarithm = std::log2(length);
      const int octave = static_cast<int>(std::floor(logarithm)) - smallest_octave;
      if (octave < 0 || octave >= octaves)
        continue;
      const int distance =
          static_cast<int>(distances * (logarithm - std::floor(logarithm)));
      // signs of normals mean nothing, nor which of the points comes first
      const int a = binOf(normals.col(i).dot(way) / length);
      const int b = binOf(normals.col(j).dot(way) / length);
      const int c = binOf(normals.col(i).dot(normals.col(j)));
      const int bin =
          ((distance * cosines + std::min(a, b)) * cosines + std::max(a, b)) * cosines +
          c;
      features(bin, octave) += 1.0f;
    }
  for (auto octave : features.colwise()) {
    const float pairs = octave.sum();
    if (pairs < fewest_pairs)
      octave.setZero();
    else
      octave = (octave / pairs).cwiseSqrt();
  }
  return features;
}

} // namespace kss
} // namespace pcl
