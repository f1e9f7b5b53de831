/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "evaluators/grid_bounds.h"
#include "support/parallel.h"
#include "support/wide_vectors.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pcl {
namespace kss {
namespace {

constexpr int lanes = 8;

/** The points nearest to a row of nodes along x, as many as lanes. */
PCL_KSS_WIDE void
nearestToNodes(const float* x,
               const float* y,
               const float* z,
               int points,
               const float* node,
               float edge,
               int* nearest)
{
  float squared[lanes], nodes[lanes];
  for (int l = 0; l < lanes; ++l) {
    squared[l] = std::numeric_limits<float>::max();
    nodes[l] = node[0] + edge * l;
    nearest[l] = 0;
  }
  for (int i = 0; i < points; ++i) {
    const float dy = y[i] - node[1], dz = z[i] - node[2];
    const float off_line = dy * dy + dz * dz;
    for (int l = 0; l < lanes; ++l) {
      const float dx = x[i] - nodes[l];
      const float d = dx * dx + off_line;
      nearest[l] = d < squared[l] ? i : nearest[l];
      squared[l] = d < squared[l] ? d : squared[l];
    }
  }
}

/** A point of a cloud, and how much smaller the squared distance of the cloud can be
 * than that of the point, from anywhere in a cell: see kernels/bounds.cl. Lengths in
 * cells. */
struct Cell {
  Eigen::Vector3f point;
  float slack;
};

struct Cells {
  BoundingGrid grid;
  std::vector<Cell> cells;
  std::vector<float> nodes; ///< their squared distances, in cells
};

/** The bounds of one direction: of the largest distance and of the mean. */
struct Bounds {
  float least_farthest = 0.0f, most_farthest = 0.0f, least_mean = 0.0f,
        most_mean = 0.0f;
};

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
    const Eigen::MatrixX3f points = cloud.transpose();
    const Eigen::Vector3i size = grid.size;
    std::vector<int> nearest(numberOfCells(size));
    inParallel(size.y() * size.z(), threads_, 32, [&](std::ptrdiff_t row) {
      for (int x = 0; x < size.x(); x += lanes) {
        const Eigen::Vector3f node =
            grid.lower +
            grid.edge *
                Eigen::Vector3i(x, row % size.y(), row / size.y()).cast<float>();
        nearestToNodes(points.col(0).data(), points.col(1).data(), points.col(2).data(),
                       static_cast<int>(points.rows()), node.data(), grid.edge,
                       &nearest[row * size.x() + x]);
      }
    });

    Cells& cells = is_source ? source_cells_ : target_cells_;
    cells.grid = grid;
    cells.cells.resize(numberOfCells(size.array() - 1));
    cells.nodes.resize(numberOfCells(size));
    const auto nodeAt = [&](int x, int y, int z) {
      return (z * size.y() + y) * size.x() + x;
    };
    for (int z = 0; z < size.z(); ++z)
      for (int y = 0; y < size.y(); ++y)
        for (int x = 0; x < size.x(); ++x) {
          const int node = nodeAt(x, y, z);
          cells.nodes[node] = ((cloud.col(nearest[node]) - grid.lower) / grid.edge -
                               Eigen::Vector3i(x, y, z).cast<float>())
                                  .squaredNorm();
        }
    inParallel((size.y() - 1) * (size.z() - 1), threads_, 32, [&](std::ptrdiff_t row) {
      for (int x = 0; x < size.x() - 1; ++x) {
        const int y = static_cast<int>(row % (size.y() - 1));
        const int z = static_cast<int>(row / (size.y() - 1));
        std::array<Eigen::Vector3f, 8> corners, at_corner;
        for (int c = 0; c < 8; ++c) {
          const Eigen::Vector3i corner(x + (c & 1), y + ((c >> 1) & 1), z + (c >> 2));
          const int node = nodeAt(corner.x(), corner.y(), corner.z());
          corners[c] = corner.cast<float>();
          at_corner[c] = (cloud.col(nearest[node]) - grid.lower) / grid.edge;
        }
        Cell& cell = cells.cells[row * (size.x() - 1) + x];
        cell = cellOf(corners, at_corner, grid.rounding);
        const Eigen::Array3i at(x, y, z);
        if (at.minCoeff() == 0 || (size.array() - 2 - at).minCoeff() == 0)
          cell.slack = grid.border;
      }
    });
  }

  static Cell
  cellOf(const std::array<Eigen::Vector3f, 8>& corners,
         const std::array<Eigen::Vector3f, 8>& nearest,
         float rounding)
  {
    const Eigen::Vector3f middle = 0.5f * (corners.front() + corners.back());
    Cell cell;
    cell.point = *std::min_element(
        nearest.begin(), nearest.end(), [&](const auto& a, const auto& b) {
          return (middle - a).squaredNorm() < (middle - b).squaredNorm();
        });
    cell.slack = 0.0f;
    float farthest = 0.0f;
    for (int c = 0; c < 8; ++c) {
      const float squared = (corners[c] - cell.point).squaredNorm();
      cell.slack =
          std::max(cell.slack, squared - (corners[c] - nearest[c]).squaredNorm());
      farthest = std::max(farthest, squared);
    }
    cell.slack += rounding * (std::sqrt(farthest) + rounding);
    return cell;
  }

  std::vector<DistanceBounds>
  lookedUp(const std::vector<Placement>& placements,
           const ProbesOfBoth& probes,
           bool interpolate,
           float limit) override
  {
    std::vector<DistanceBounds> bounds(placements.size());
    inParallel(placements.size(), threads_, 64, [&](std::ptrdiff_t i) {
      // the inverse of x -> s R x + t is x -> (s R)^T (x - t) / s^2
      const Eigen::Matrix3f linear = placements[i].leftCols<3>();
      const float scale = linear.row(0).norm();
      Placement back;
      back.leftCols<3>() = linear.transpose() / (scale * scale);
      back.col(3) = -back.leftCols<3>() * placements[i].col(3);
      const Bounds forth = boundsFrom(probes.source, placements[i], target_cells_,
                                      interpolate, scale, limit);
      const Bounds from_target = boundsFrom(probes.target, back, source_cells_,
                                            interpolate, 1.0f / scale, limit / scale);
      bounds[i] = {{forth.least_farthest, forth.least_mean,
                    scale * from_target.least_farthest, scale * from_target.least_mean},
                   {forth.most_farthest, forth.most_mean,
                    scale * from_target.most_farthest, scale * from_target.most_mean}};
    });
    return bounds;
  }

  /** What is nowhere larger than the squared distance of a position within a cell. */
  static float
  interpolated(const Cells& cells, const Eigen::Array3i& cell, const Eigen::Array3f& p)
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

  static Bounds
  boundsFrom(const Probes& probes,
             const Placement& placement,
             const Cells& cells,
             bool interpolate,
             float scale,
             float limit)
  {
    Bounds bounds;
    if (probes.rows() == 0)
      return bounds;
    // all lengths in cells from the first node
    const BoundingGrid& grid = cells.grid;
    const float inverse = 1.0f / grid.edge;
    Placement rows = placement * inverse;
    rows.col(3) -= grid.lower * inverse;
    limit *= inverse;
    scale *= inverse;
    const Eigen::Array3i last = grid.size.array() - 2;
    double least_sum = 0.0, most_sum = 0.0;
    for (Eigen::Index i = 0; i < probes.rows(); ++i) {
      const Eigen::Vector3f p =
          rows * probes.row(i).head<3>().transpose().homogeneous();
      const Eigen::Array3i at = toIndices(p, last);
      const Cell& cell =
          cells.cells[(at.z() * (grid.size.y() - 1) + at.y()) * (grid.size.x() - 1) +
                      at.x()];
      const float squared = (p - cell.point).squaredNorm();
      float least_squared = squared - cell.slack;
      // not at the border, since beyond it nothing can be interpolated
      if (interpolate && std::abs(cell.slack) < 1e29f) {
        const float closer = interpolated(cells, at, p.array() - at.cast<float>());
        least_squared =
            std::max(least_squared, closer - grid.rounding * (1.5f + std::abs(closer)));
      }
      const float least =
          std::min(std::sqrt(std::max(least_squared, 0.0f)), grid.largest_known);
      const float most = std::sqrt(squared);

      const float share = probes(i, 3), reach = scale * probes(i, 4),
                  mean = probes(i, 5);
      bounds.least_farthest = std::max(bounds.least_farthest, least);
      bounds.most_farthest = std::max(bounds.most_farthest, most + reach);
      const float counts = std::min(least, limit);
      const float nearest = std::min(least - reach, limit);
      least_sum += share * std::max(counts - mean * (counts - nearest), 0.0f);
      most_sum += share * std::min(most + mean * reach, limit);
    }
    bounds.least_farthest *= grid.edge;
    bounds.most_farthest *= grid.edge;
    bounds.least_mean = grid.edge * static_cast<float>(least_sum);
    bounds.most_mean = grid.edge * static_cast<float>(most_sum);
    return bounds;
  }

  unsigned int threads_;
  Cells source_cells_, target_cells_;
};

} // namespace

std::unique_ptr<BoundsEvaluator>
makeHostBounds(unsigned int threads)
{
  return std::make_unique<HostBounds>(threads);
}

} // namespace kss
} // namespace pcl
