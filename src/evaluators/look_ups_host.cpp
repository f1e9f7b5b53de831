/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "evaluators/look_up_clouds.h"
#include "evaluators/look_ups.h"
#include "geometry/distance_field.h"
#include "support/parallel.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pcl {
namespace kss {
namespace {

/** What look-ups need of one cloud. */
struct HostLookUpCloud {
  Points probes;
  DistanceField field;
};

class HostLookUps : public DistanceEvaluator {
public:
  HostLookUps(unsigned int threads, unsigned int probes)
  : threads_(threads)
  , clouds_(probes)
  {
  }

  void
  setClouds(const Points& source, const Points& target, float limit) override
  {
    clouds_.set(source, target, limit, [](const Points& probes, DistanceField&& field) {
      return HostLookUpCloud{probes, std::move(field)};
    });
  }

  std::vector<DirectedDistances>
  evaluate(const std::vector<Placement>& placements) override
  {
    std::vector<DirectedDistances> distances(placements.size());
    inParallel(placements.size(), threads_, 64, [&](std::ptrdiff_t i) {
      const HostLookUpCloud &source = clouds_.source(), &target = clouds_.target();
      const float scale = scaleFactorOf(placements[i]), limit = clouds_.limit();
      const auto [far_source, mean_source] =
          distancesFrom(source.probes, placements[i], target.field, limit);
      const auto [far_target, mean_target] = distancesFrom(
          target.probes, inverseOf(placements[i]), source.field, limit / scale);
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
                const Placement& placement,
                const DistanceField& field,
                float limit)
  {
    const Eigen::Affine3f place = affineOf(placement);
    float farthest = 0.0f;
    double sum = 0.0;
    for (Eigen::Index i = 0; i < points.cols(); ++i) {
      const float distance = field.distances()[field.cellOf(place * points.col(i))];
      farthest = std::max(farthest, distance);
      sum += std::min(distance, limit);
    }
    return {farthest, static_cast<float>(sum / points.cols())};
  }

  unsigned int threads_;
  LookUpClouds<HostLookUpCloud> clouds_;
};

} // namespace

std::unique_ptr<DistanceEvaluator>
makeHostLookUps(unsigned int threads, unsigned int probes)
{
  return std::make_unique<HostLookUps>(threads, probes);
}

} // namespace kss
} // namespace pcl
