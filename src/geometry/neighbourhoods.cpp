/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "geometry/neighbourhoods.h"

#include "geometry/cell_grid.h"
#include "geometry/clouds.h"
#include "support/parallel.h"
#include "support/wide_vectors.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

namespace pcl {
namespace kss {

namespace {

/** How far around a cell neighbours are looked for before all points are asked. */
constexpr int most_rings = 2;

/** The edge of cells that hold so many points on average. */
float
edgeFor(const Points& points, float held)
{
  const float longest = longestEdge(points);
  if (!(longest > 0.0f))
    return 1.0f;
  // The points of a surface grow with the square of the edge; of a line or a filled
  // body a little otherwise, hence a few rounds.
  const auto size = static_cast<float>(points.cols());
  float edge = longest * std::sqrt(held / size);
  for (int round = 0; round < 4; ++round) {
    edge = std::max(edge, longest / CellLattice::most);
    const CellLattice cells(points, edge);
    KeyTable table(points.cols() / 4);
    for (Eigen::Index i = 0; i < points.cols(); ++i)
      table.add(keyOf(cells.of(points.col(i))));
    const float found = size / static_cast<float>(table.size());
    if (found > 0.7f * held && found < 1.4f * held)
      break;
    edge *= std::sqrt(held / found);
  }
  return edge;
}

/** Points among which neighbours are looked for: coordinates, and indices. */
struct Surroundings {
  std::vector<float> x, y, z, squared;
  std::vector<int> indices;

  void
  clear()
  {
    x.clear();
    y.clear();
    z.clear();
    indices.clear();
  }

  void
  add(const Points& points, int index)
  {
    x.push_back(points(0, index));
    y.push_back(points(1, index));
    z.push_back(points(2, index));
    indices.push_back(index);
  }
};

PCL_KSS_WIDE void
measure(Surroundings& around, float x, float y, float z)
{
  const auto size = around.indices.size();
  around.squared.resize(size);
  const float* const xs = around.x.data();
  const float* const ys = around.y.data();
  const float* const zs = around.z.data();
  float* const squared = around.squared.data();
  for (std::size_t i = 0; i < size; ++i)
    squared[i] = (xs[i] - x) * (xs[i] - x) + (ys[i] - y) * (ys[i] - y) +
                 (zs[i] - z) * (zs[i] - z);
}

/** For each value, how many come before it in the sorted order. */
PCL_KSS_WIDE void
rank(const float* values, int n, int* ranks)
{
  for (int i = 0; i < n; ++i) {
    const float value = values[i];
    int before = 0;
    for (int j = 0; j < n; ++j)
      before += values[j] < value;
    for (int j = 0; j < i; ++j) // equal ones: in the order in which they came
      before += values[j] == value;
    ranks[i] = before;
  }
}

/** Picks the nearest of some points, in the order of their distance. */
class Nearest {
public:
  /** Find \a count neighbours of a point within a squared radius; false: there are
   * fewer.
   */
  template <typename Indices, typename Distances>
  bool
  find(int point,
       int count,
       float squared_radius,
       const Surroundings& around,
       Indices indices,
       Distances distances)
  {
    const int size = static_cast<int>(around.indices.size());
    squared_.resize(size);
    indices_.resize(size);
    int n = 0;
    for (int i = 0; i < size; ++i) { // without branches, which would be hard to foresee
      squared_[n] = around.squared[i];
      indices_[n] = around.indices[i];
      n += around.squared[i] <= squared_radius && around.indices[i] != point;
    }
    if (n < count)
      return false;
    ranks_.resize(n);
    constexpr int few = 96; // ranking takes the square of their number
    if (n <= few)
      rank(squared_.data(), n, ranks_.data());
    else {
      std::vector<int> order(n);
      std::iota(order.begin(), order.end(), 0);
      std::partial_sort(
          order.begin(), order.begin() + count, order.end(), [this](int a, int b) {
            return squared_[a] != squared_[b] ? squared_[a] < squared_[b] : a < b;
          });
      std::fill(ranks_.begin(), ranks_.end(), count);
      for (int r = 0; r < count; ++r)
        ranks_[order[r]] = r;
    }
    for (int i = 0; i < n; ++i)
      if (ranks_[i] < count) {
        indices[ranks_[i]] = indices_[i];
        distances[ranks_[i]] = std::sqrt(squared_[i]);
      }
    return true;
  }

private:
  std::vector<float> squared_;
  std::vector<int> indices_, ranks_;
};

/** The points in the cells that are so many away at most. */
void
gather(const Points& points,
       const CellGrid& grid,
       const Cell& cell,
       int rings,
       Surroundings& around)
{
  around.clear();
  for (int x = -rings; x <= rings; ++x)
    for (int y = -rings; y <= rings; ++y)
      for (int z = -rings; z <= rings; ++z) {
        const int other = grid.find(cell + Cell(x, y, z));
        if (other >= 0)
          for (int i = grid.begin(other); i < grid.begin(other + 1); ++i)
            around.add(points, grid.order()[i]);
      }
}

} // namespace

Neighbourhoods
neighbourhoodsOf(const Points& points, int neighbours, unsigned int threads)
{
  const Eigen::Index size = points.cols();
  const int k = static_cast<int>(std::min<Eigen::Index>(neighbours, size - 1));
  Neighbourhoods found{Eigen::MatrixXi(k, size), Eigen::MatrixXf(k, size)};
  // a block of cells then holds the neighbours of most points
  const CellGrid grid(points, edgeFor(points, 0.4f * static_cast<float>(neighbours)));
  const float edge = grid.cells().edge();
  // of the coordinates of cells
  const float rounding =
      4.0f * std::numeric_limits<float>::epsilon() * longestEdge(points);
  inParallel(grid.occupied().size(), threads, 64, [&](std::ptrdiff_t c) {
    thread_local Surroundings around;
    thread_local Nearest nearest;
    const Cell& cell = grid.occupied()[c];
    const Eigen::Vector3f corner = grid.cells().cornerOf(cell);
    std::vector<int> open(grid.order().begin() + grid.begin(c),
                          grid.order().begin() + grid.begin(c + 1));
    for (int rings = 1; !open.empty(); ++rings) {
      const bool all = rings > most_rings;
      if (all) {
        around.clear();
        for (int i = 0; i < size; ++i)
          around.add(points, i);
      }
      else
        gather(points, grid, cell, rings, around);
      std::vector<int> still_open;
      for (const int i : open) {
        const Eigen::Vector3f point = points.col(i);
        // how far the cells that were asked reach, at least; rounding aside
        const Eigen::Vector3f inside = point - corner;
        const float reach = (rings - 1e-3f) * edge - rounding +
                            std::min(inside.minCoeff(), edge - inside.maxCoeff());
        measure(around, point.x(), point.y(), point.z());
        const float radius = all ? std::numeric_limits<float>::infinity()
                                 : std::max(0.0f, reach) * reach;
        if (!nearest.find(i, k, radius, around, found.indices.col(i),
                          found.distances.col(i)))
          still_open.push_back(i);
      }
      open.swap(still_open);
    }
  });
  return found;
}

std::optional<Neighbourhoods>
restrictedTo(const Neighbourhoods& neighbourhoods,
             const std::vector<int>& kept,
             int neighbours)
{
  std::vector<int> number(neighbourhoods.indices.cols(), -1);
  for (std::size_t i = 0; i < kept.size(); ++i)
    number[kept[i]] = static_cast<int>(i);
  Neighbourhoods rest{Eigen::MatrixXi(neighbours, kept.size()),
                      Eigen::MatrixXf(neighbours, kept.size())};
  for (std::size_t i = 0; i < kept.size(); ++i) {
    int found = 0;
    for (Eigen::Index n = 0; n < neighbourhoods.indices.rows() && found < neighbours;
         ++n) {
      const int other = number[neighbourhoods.indices(n, kept[i])];
      if (other >= 0) {
        rest.indices(found, i) = other;
        rest.distances(found, i) = neighbourhoods.distances(n, kept[i]);
        ++found;
      }
    }
    if (found < neighbours)
      return {};
  }
  return rest;
}

Eigen::VectorXf
surfaceVariation(const Points& points,
                 const Neighbourhoods& neighbourhoods,
                 unsigned int threads)
{
  const Eigen::Index size = points.cols(), k = neighbourhoods.indices.rows();
  Eigen::VectorXf variation(size);
  inParallel(size, threads, 500, [&](Eigen::Index i) {
    Points around(3, k);
    for (Eigen::Index n = 0; n < k; ++n)
      around.col(n) = points.col(neighbourhoods.indices(n, i));
    around.colwise() -= around.rowwise().mean().eval();
    const Eigen::Matrix3f scatter = around * around.transpose();
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3f> solver;
    solver.computeDirect(scatter, Eigen::EigenvaluesOnly);
    const float total = scatter.trace();
    variation[i] =
        total > 0.0f ? std::max(0.0f, solver.eigenvalues()[0]) / total : 0.0f;
  });
  return variation;
}

Eigen::VectorXf
spacingOf(const Neighbourhoods& neighbourhoods)
{
  // the k-th neighbour's circle holds k points
  const Eigen::Index k = std::min<Eigen::Index>(6, neighbourhoods.distances.rows());
  if (k == 0)
    return Eigen::VectorXf::Zero(neighbourhoods.distances.cols());
  return neighbourhoods.distances.row(k - 1).transpose() *
         std::sqrt(static_cast<float>(M_PI) / k);
}

} // namespace kss
} // namespace pcl
