/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "evaluators/bounding_cells.h"

#include "support/parallel.h"
#include "support/wide_vectors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

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

/** Of all nodes, the point nearest to each. */
std::vector<int>
nearestToNodes(const Points& cloud, const BoundingGrid& grid, unsigned int threads)
{
  const Eigen::MatrixX3f points = cloud.transpose();
  const Eigen::Vector3i& size = grid.size;
  std::vector<int> nearest(numberOfCells(size));
  inParallel(size.y() * size.z(), threads, 32, [&](std::ptrdiff_t row) {
    for (int x = 0; x < size.x(); x += lanes) {
      const Eigen::Vector3f node =
          grid.lower +
          grid.edge * Eigen::Vector3i(x, row % size.y(), row / size.y()).cast<float>();
      nearestToNodes(points.col(0).data(), points.col(1).data(), points.col(2).data(),
                     static_cast<int>(points.rows()), node.data(), grid.edge,
                     &nearest[row * size.x() + x]);
    }
  });
  return nearest;
}

/** The squared distances of all nodes from the points nearest to them, in cells. */
std::vector<float>
squaredDistances(const Points& cloud,
                 const BoundingGrid& grid,
                 const std::vector<int>& nearest)
{
  std::vector<float> squared(nearest.size());
  std::size_t node = 0;
  for (int z = 0; z < grid.size.z(); ++z)
    for (int y = 0; y < grid.size.y(); ++y)
      for (int x = 0; x < grid.size.x(); ++x, ++node)
        squared[node] = ((cloud.col(nearest[node]) - grid.lower) / grid.edge -
                         Eigen::Vector3i(x, y, z).cast<float>())
                            .squaredNorm();
  return squared;
}

/** A cell, of whose corners the nearest points are known. */
BoundingCell
cellOf(const std::array<Eigen::Vector3f, 8>& corners,
       const std::array<Eigen::Vector3f, 8>& nearest,
       float rounding)
{
  const Eigen::Vector3f middle = 0.5f * (corners.front() + corners.back());
  BoundingCell cell;
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

/** The cells between all nodes. */
std::vector<BoundingCell>
cellsBetween(const Points& cloud,
             const BoundingGrid& grid,
             const std::vector<int>& nearest,
             unsigned int threads)
{
  const Eigen::Vector3i& nodes = grid.size;
  const Eigen::Vector3i size = nodes.array() - 1;
  std::vector<BoundingCell> cells(numberOfCells(size));
  inParallel(size.y() * size.z(), threads, 32, [&](std::ptrdiff_t row) {
    const int y = static_cast<int>(row % size.y());
    const int z = static_cast<int>(row / size.y());
    for (int x = 0; x < size.x(); ++x) {
      std::array<Eigen::Vector3f, 8> corners, at_corner;
      for (int c = 0; c < 8; ++c) {
        const Eigen::Vector3i corner(x + (c & 1), y + ((c >> 1) & 1), z + (c >> 2));
        const int node = (corner.z() * nodes.y() + corner.y()) * nodes.x() + corner.x();
        corners[c] = corner.cast<float>();
        at_corner[c] = (cloud.col(nearest[node]) - grid.lower) / grid.edge;
      }
      BoundingCell& cell = cells[row * size.x() + x];
      cell = cellOf(corners, at_corner, grid.rounding);
      const Eigen::Array3i at(x, y, z);
      if (at.minCoeff() == 0 || (size.array() - 1 - at).minCoeff() == 0)
        cell.slack = grid.border;
    }
  });
  return cells;
}

} // namespace

BoundingCells
boundingCells(const Points& cloud, const BoundingGrid& grid, unsigned int threads)
{
  const std::vector<int> nearest = nearestToNodes(cloud, grid, threads);
  return {grid, cellsBetween(cloud, grid, nearest, threads),
          squaredDistances(cloud, grid, nearest)};
}

} // namespace kss
} // namespace pcl
