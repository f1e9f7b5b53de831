/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "evaluators/look_up_clouds.h"
#include "evaluators/look_ups.h"
#include "geometry/distance_field.h"
#include "support/parallel.h"
#include "support/wide_vectors.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace pcl {
namespace kss {
namespace {

/** What look-ups need of one cloud. */
struct HostLookUpCloud {
  Eigen::MatrixX3f probes; ///< coordinates apart
  DistanceField field;
};

/** The distances of points, looked up at their cells. */
struct LookedUp {
  float farthest, sum;
};

/** As in look_ups.cl.
 * \param[in] probes points, coordinates apart
 * \param[in] to_cells places them, in cells of the field, row by row
 * \param[in] distances of the cells
 * \param[in] size of the field in cells
 * \param[in] limit what a distance counts in the sum at most
 */
PCL_KSS_WIDE LookedUp
lookUp(const Eigen::MatrixX3f& probes,
       const Placement& to_cells,
       const std::vector<float>& distances,
       const Eigen::Vector3i& size,
       float limit)
{
  const Eigen::Index points = probes.rows();
  constexpr Eigen::Index many = 64; // so that loops over them become vectors
  const Eigen::Array3f last = (size.array() - 1).cast<float>();
  LookedUp looked_up{0.0f, 0.0f};
  for (Eigen::Index begin = 0; begin < points; begin += many) {
    const auto n = static_cast<int>(std::min(many, points - begin));
    const float *const x = &probes(begin, 0), *const y = &probes(begin, 1),
                       *const z = &probes(begin, 2);
    int at[3][many];
    for (int axis = 0; axis < 3; ++axis) {
      const float a = to_cells(axis, 0), b = to_cells(axis, 1), c = to_cells(axis, 2),
                  d = to_cells(axis, 3), most = last[axis];
      for (int i = 0; i < n; ++i) {
        const float coordinate = a * x[i] + b * y[i] + c * z[i] + d;
        const float inside = coordinate > 0.0f ? coordinate : 0.0f;
        at[axis][i] = static_cast<int>(inside < most ? inside : most);
      }
    }
    int cells[many];
    for (int i = 0; i < n; ++i)
      cells[i] = (at[2][i] * size[1] + at[1][i]) * size[0] + at[0][i];
    for (int i = 0; i < n; ++i) {
      const float distance = distances[cells[i]];
      looked_up.farthest = std::max(looked_up.farthest, distance);
      looked_up.sum += std::min(distance, limit);
    }
  }
  return looked_up;
}

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
      return HostLookUpCloud{probes.transpose(), std::move(field)};
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
          distancesFrom(source, placements[i], target.field, limit);
      const auto [far_target, mean_target] =
          distancesFrom(target, inverseOf(placements[i]), source.field, limit / scale);
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
  distancesFrom(const HostLookUpCloud& cloud,
                const Placement& placement,
                const DistanceField& field,
                float limit)
  {
    Placement to_cells = placement;
    to_cells.col(3) -= field.lower();
    to_cells *= field.inverseEdge();
    const LookedUp found =
        lookUp(cloud.probes, to_cells, field.distances(), field.size(), limit);
    return {found.farthest, found.sum / static_cast<float>(cloud.probes.rows())};
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
