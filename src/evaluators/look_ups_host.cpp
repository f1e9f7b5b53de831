/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "evaluators/distance_evaluator.h"
#include "evaluators/look_up_field.h"
#include "geometry/distance_field.h"
#include "support/parallel.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace pcl {
namespace kss {
namespace {

class HostLookUpEvaluator : public DistanceEvaluator {
public:
  HostLookUpEvaluator(unsigned int threads, unsigned int probes)
  : threads_(threads)
  , probes_(probes)
  {
  }

  void
  setClouds(const Points& source, const Points& target, float limit) override
  {
    source_ = source.leftCols(std::min<Eigen::Index>(probes_, source.cols()));
    target_ = target.leftCols(std::min<Eigen::Index>(probes_, target.cols()));
    limit_ = limit;
    source_field_.emplace(lookUpField(source, limit));
    target_field_.emplace(lookUpField(target, limit));
  }

  std::vector<DirectedDistances>
  evaluate(const std::vector<Placement>& placements) override
  {
    std::vector<DirectedDistances> distances(placements.size());
    inParallel(placements.size(), threads_, 64, [&](std::ptrdiff_t i) {
      // the inverse of x -> s R x + t is x -> (s R)^T (x - t) / s^2
      const Eigen::Affine3f forth(
          (Eigen::Matrix4f() << placements[i], 0.0f, 0.0f, 0.0f, 1.0f).finished());
      const float scale = forth.linear().row(0).norm();
      Eigen::Affine3f back = Eigen::Affine3f::Identity();
      back.linear() = forth.linear().transpose() / (scale * scale);
      back.translation() = -back.linear() * forth.translation();
      const auto [far_source, mean_source] =
          distancesFrom(source_, forth, *target_field_, limit_);
      const auto [far_target, mean_target] =
          distancesFrom(target_, back, *source_field_, limit_ / scale);
      distances[i] = {far_source, mean_source, scale * far_target, scale * mean_target};
    });
    return distances;
  }

  std::string
  deviceName() const override
  {
    return "host";
  }

private:
  static std::pair<float, float>
  distancesFrom(const Points& points,
                const Eigen::Affine3f& placement,
                const DistanceField& field,
                float limit)
  {
    float farthest = 0.0f;
    double sum = 0.0;
    for (Eigen::Index i = 0; i < points.cols(); ++i) {
      const float distance = field.distances()[field.cellOf(placement * points.col(i))];
      farthest = std::max(farthest, distance);
      sum += std::min(distance, limit);
    }
    return {farthest, static_cast<float>(sum / points.cols())};
  }

  unsigned int threads_;
  unsigned int probes_;
  Points source_, target_;
  std::optional<DistanceField> source_field_, target_field_;
  float limit_ = 0.0f;
};

} // namespace

std::unique_ptr<DistanceEvaluator>
makeHostLookUps(unsigned int threads, unsigned int probes)
{
  return std::make_unique<HostLookUpEvaluator>(threads, probes);
}

} // namespace kss
} // namespace pcl
