/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "evaluators/bounding_cells.h"
#include "evaluators/grid_bounds.h"
#include "support/parallel.h"

#include <algorithm>
#include <cmath>

namespace pcl {
namespace kss {
namespace {

/** The bounds of one direction: of the largest distance and of the mean. */
struct DirectedBounds {
  float least_farthest = 0.0f, most_farthest = 0.0f, least_mean = 0.0f,
        most_mean = 0.0f;
};

/** What is nowhere larger than the squared distance of a position within a cell. */
float
interpolated(const BoundingCells& cells,
             const Eigen::Array3i& cell,
             const Eigen::Array3f& p)
{
  const Eigen::Vector3i& size = cells.grid.size;
  float sum = 0.0f;
  for (int c = 0; c < 8; ++c) {
    const Eigen::Array3i corner(c & 1, (c >> 1) & 1, c >> 2);
    const Eigen::Array3i node = cell + corner;
    const Eigen::Array3f at = corner.cast<float>();
    sum += (at * p + (1.0f - at) * (1.0f - p)).prod() *
           cells.nodes[(node.z() * size.y() + node.y()) * size.x() + node.x()];
  }
  // |p|^2 is interpolated, too
  return sum - (p * (1.0f - p)).sum();
}

/** The least and the largest distance of a position, all lengths in cells from the
 * first node. */
struct PositionBounds {
  float least, most;
};

inline PositionBounds
boundsAt(const Eigen::Vector3f& p, const BoundingCells& cells, bool interpolate)
{
  const BoundingGrid& grid = cells.grid;
  const Eigen::Vector3i& size = grid.size;
  const Eigen::Array3i at = toIndices(p, size.array() - 2);
  const BoundingCell& cell =
      cells.cells[(at.z() * (size.y() - 1) + at.y()) * (size.x() - 1) + at.x()];
  const float squared = (p - cell.point).squaredNorm();
  float least_squared = squared - cell.slack;
  // not at the border, since beyond it nothing can be interpolated
  if (interpolate && std::abs(cell.slack) < 1e29f) {
    const float closer = interpolated(cells, at, p.array() - at.cast<float>());
    least_squared =
        std::max(least_squared, closer - grid.rounding * (1.5f + std::abs(closer)));
  }
  return {std::min(std::sqrt(std::max(least_squared, 0.0f)), grid.largest_known),
          std::sqrt(squared)};
}

DirectedBounds
boundsFrom(const Probes& probes,
           const Placement& placement,
           const BoundingCells& cells,
           bool interpolate,
           float scale,
           float limit)
{
  DirectedBounds bounds;
  if (probes.rows() == 0)
    return bounds;
  // all lengths in cells from the first node
  const float edge = cells.grid.edge;
  const float inverse = 1.0f / edge;
  Placement rows = placement * inverse;
  rows.col(3) -= cells.grid.lower * inverse;
  limit *= inverse;
  scale *= inverse;
  double least_sum = 0.0, most_sum = 0.0;
  for (Eigen::Index i = 0; i < probes.rows(); ++i) {
    const Eigen::Vector3f p = rows * probes.row(i).head<3>().transpose().homogeneous();
    const auto [least, most] = boundsAt(p, cells, interpolate);
    const float share = probes(i, 3), reach = scale * probes(i, 4), mean = probes(i, 5);
    bounds.least_farthest = std::max(bounds.least_farthest, least);
    bounds.most_farthest = std::max(bounds.most_farthest, most + reach);
    const float counts = std::min(least, limit);
    const float nearest = std::min(least - reach, limit);
    least_sum += share * std::max(counts - mean * (counts - nearest), 0.0f);
    most_sum += share * std::min(most + mean * reach, limit);
  }
  bounds.least_farthest *= edge;
  bounds.most_farthest *= edge;
  bounds.least_mean = edge * static_cast<float>(least_sum);
  bounds.most_mean = edge * static_cast<float>(most_sum);
  return bounds;
}

class HostBounds : public GridBounds {
public:
  explicit HostBounds(unsigned int threads)
  : threads_(threads)
  {
  }

private:
  void
  setCells(bool is_source, const Points& cloud, const BoundingGrid& grid) override
  {
    (is_source ? source_cells_ : target_cells_) = boundingCells(cloud, grid, threads_);
  }

  std::vector<DistanceBounds>
  lookedUp(const std::vector<Placement>& placements,
           const ProbesOfBoth& probes,
           bool interpolate,
           float limit) override
  {
    std::vector<DistanceBounds> bounds(placements.size());
    inParallel(placements.size(), threads_, 64, [&](std::ptrdiff_t i) {
      const float scale = scaleFactorOf(placements[i]);
      const DirectedBounds forth = boundsFrom(probes.source, placements[i],
                                              target_cells_, interpolate, scale, limit);
      const DirectedBounds back =
          boundsFrom(probes.target, inverseOf(placements[i]), source_cells_,
                     interpolate, 1.0f / scale, limit / scale);
      bounds[i] = {{forth.least_farthest, forth.least_mean, scale * back.least_farthest,
                    scale * back.least_mean},
                   {forth.most_farthest, forth.most_mean, scale * back.most_farthest,
                    scale * back.most_mean}};
    });
    return bounds;
  }

  unsigned int threads_;
  BoundingCells source_cells_, target_cells_;
};

} // namespace

std::unique_ptr<BoundsEvaluator>
makeHostBounds(unsigned int threads)
{
  return std::make_unique<HostBounds>(threads);
}

} // namespace kss
} // namespace pcl
