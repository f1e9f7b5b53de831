/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "evaluators/coordinate_columns.h"
#include "evaluators/pair_distances.h"
#include "support/parallel.h"
#include "support/wide_vectors.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl {
namespace kss {
namespace {

constexpr int lanes = 16;

/** The squared distance of one placed source point to its nearest target point; on the
 * way, nearest[] of every target point is brought down to the distance from it. */
PCL_KSS_WIDE float
meet(const float* x,
     const float* y,
     const float* z,
     int n,
     const float* p,
     float* nearest)
{
  float column[lanes];
  std::fill(column, column + lanes, std::numeric_limits<float>::max());
  for (int t = 0; t < n; t += lanes)
    for (int l = 0; l < lanes; ++l) {
      const float dx = x[t + l] - p[0];
      const float dy = y[t + l] - p[1];
      const float dz = z[t + l] - p[2];
      const float d = dx * dx + dy * dy + dz * dz;
      column[l] = d < column[l] ? d : column[l];
      nearest[t + l] = d < nearest[t + l] ? d : nearest[t + l];
    }
  return *std::min_element(column, column + lanes);
}

class HostPairDistances : public DistanceEvaluator {
public:
  explicit HostPairDistances(unsigned int threads)
  : threads_(threads)
  {
  }

  void
  setClouds(const Points& source, const Points& target, float limit) override
  {
    limit_ = limit;
    source_ = source;
    target_points_ = target.cols();
    target_ = coordinateColumns(target, lanes);
  }

  std::vector<DirectedDistances>
  evaluate(const std::vector<Placement>& placements) override
  {
    std::vector<DirectedDistances> distances(placements.size());
    inParallel(placements.size(), threads_, 1,
               [&](std::ptrdiff_t i) { distances[i] = distancesAt(placements[i]); });
    return distances;
  }

  std::string
  deviceName() const override
  {
    return "host";
  }

private:
  DirectedDistances
  distancesAt(const Placement& placement) const
  {
    std::vector<float> nearest(target_.rows(), std::numeric_limits<float>::max());
    float farthest_source = 0.0f;
    double sum_source = 0.0;
    for (Eigen::Index i = 0; i < source_.cols(); ++i) {
      const Eigen::Vector3f p = placement * source_.col(i).homogeneous();
      const float squared =
          meet(target_.col(0).data(), target_.col(1).data(), target_.col(2).data(),
               static_cast<int>(target_.rows()), p.data(), nearest.data());
      farthest_source = std::max(farthest_source, squared);
      sum_source += std::min(std::sqrt(squared), limit_);
    }
    float farthest_target = 0.0f;
    double sum_target = 0.0;
    for (Eigen::Index t = 0; t < target_points_; ++t) {
      farthest_target = std::max(farthest_target, nearest[t]);
      sum_target += std::min(std::sqrt(nearest[t]), limit_);
    }
    return {std::sqrt(farthest_source), static_cast<float>(sum_source / source_.cols()),
            std::sqrt(farthest_target),
            static_cast<float>(sum_target / target_points_)};
  }

  unsigned int threads_;
  Points source_;
  Eigen::MatrixX3f target_;
  Eigen::Index target_points_ = 0;
  float limit_ = 0.0f;
};

} // namespace

std::unique_ptr<DistanceEvaluator>
makeHostPairDistances(unsigned int threads)
{
  return std::make_unique<HostPairDistances>(threads);
}

} // namespace kss
} // namespace pcl
