/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "scans/local_features.h"

#include <pcl/registration/kss/scan_work.h>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace pcl {
namespace kss {
namespace {

/** Bins of the distance, and of each of two cosines in [0, 1]. */
constexpr int shells = 4, cosines = 5;

int
binOf(float share, int bins)
{
  return std::min(bins - 1, static_cast<int>(static_cast<float>(bins) * share));
}

static_assert(shells * cosines * cosines == std::tuple_size<LocalFeature>());

} // namespace

Eigen::MatrixXf
localFeatures(const Points& points,
              const Points& normals,
              const std::vector<int>& chosen,
              float reach)
{
  Eigen::MatrixXf features =
      Eigen::MatrixXf::Zero(shells * cosines * cosines, chosen.size());
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    const Eigen::Vector3f point = points.col(chosen[i]);
    const Eigen::Vector3f normal = normals.col(chosen[i]);
    auto feature = features.col(i);
    for (Eigen::Index j = 0; j < points.cols(); ++j) {
      const Eigen::Vector3f way = points.col(j) - point;
      const float squared = way.squaredNorm();
      if (squared >= reach * reach || squared <= 0.0f)
        continue;
      const float length = std::sqrt(squared);
      const int shell = binOf(length / reach, shells);
      const int rise = binOf(std::abs(normal.dot(way)) / length, cosines);
      const int turn = binOf(std::abs(normal.dot(normals.col(j))), cosines);
      feature[(shell * cosines + rise) * cosines + turn] += 1.0f;
    }
    // of each shell the shares: outer ones would outweigh inner ones
    for (int shell = 0; shell < shells; ++shell) {
      auto bins = feature.segment(shell * cosines * cosines, cosines * cosines);
      const float sum = bins.sum();
      if (sum > 0.0f)
        bins = (bins / (sum * static_cast<float>(shells))).cwiseSqrt();
    }
  }
  return features;
}

} // namespace kss
} // namespace pcl
