/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "geometry/neighbourhoods.h"

#include "geometry/clouds.h"
#include "geometry/packed_points.h"
#include "support/parallel.h"
#include "support/rounded_up.h"
#include "support/wide_vectors.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

namespace pcl {
namespace kss {

namespace {

using Leaf = PackedPoints::Leaf;
constexpr int leaf_size = PackedPoints::leaf_size;

/** How far around a leaf neighbours are looked for first, in diagonals of its box. */
constexpr float first_reach = 0.35f;

/** Points with coordinates apart, so that vectors hold them. */
struct Columns {
  std::vector<float> x, y, z;
  std::vector<int> indices;

  void
  resize(std::size_t size)
  {
    x.resize(size);
    y.resize(size);
    z.resize(size);
    indices.resize(size);
  }
};

/** Those of some points, but for the one that asks, that are no farther from it than
 * asked for: their squared distances and places; how many there are. */
PCL_KSS_WIDE int
collect(const float* xs,
        const float* ys,
        const float* zs,
        int size,
        const float* position,
        int own_place,
        float squared_radius,
        float* squared,
        int* places)
{
  const float x = position[0], y = position[1], z = position[2];
  const int own_block = own_place / lanes * lanes;
  const float beyond =
      std::nextafter(squared_radius, std::numeric_limits<float>::infinity());
  int n = 0;
  for (int begin = 0; begin < size; begin += lanes) {
    float block[lanes];
    for (int l = 0; l < lanes; ++l) {
      const int i = begin + l;
      block[l] = (xs[i] - x) * (xs[i] - x) + (ys[i] - y) * (ys[i] - y) +
                 (zs[i] - z) * (zs[i] - z);
    }
    unsigned int near = whichBelow(block, beyond);
    if (begin == own_block)
      near &= ~(1u << own_place % lanes);
    for (; near != 0; near &= near - 1) {
      const int l = __builtin_ctz(near);
      squared[n] = block[l];
      places[n++] = begin + l;
    }
  }
  return n;
}

/** For each of whole vectors of values, how many come before it in the sorted order. */
PCL_KSS_WIDE void
rank(const float* values, int filled, int* ranks)
{
  for (int i = 0; i < filled; ++i) {
    const float value = values[i];
    int before = 0;
    for (int j = 0; j < filled; ++j) // equal ones: in the order in which they came
      before += (values[j] < value) | ((values[j] == value) & (j < i));
    ranks[i] = before;
  }
}

/** Which points of a leaf lie within a distance of a box: a bit for each. */
unsigned int
whichWithin(const Leaf& leaf, const Eigen::AlignedBox3f& box, float squared_distance)
{
  using Coordinates = Eigen::Array<float, leaf_size, 1>;
  float squared[leaf_size] = {};
  for (const auto& [coordinates, axis] :
       {std::make_pair(leaf.x, 0), {leaf.y, 1}, {leaf.z, 2}}) {
    const Coordinates at = Eigen::Map<const Coordinates>(coordinates);
    Eigen::Map<Coordinates>(squared) +=
        (box.min()[axis] - at).max(at - box.max()[axis]).max(0.0f).square();
  }
  return whichBelow(squared, squared_distance);
}

/** What finds the neighbours of a point among those around it. */
class Nearby {
public:
  /** The points around a leaf, those within a distance of its box among them. */
  void
  gather(const PackedPoints& points, std::size_t own, float distance)
  {
    const Eigen::AlignedBox3f box = points.boxOf(own);
    points.leavesWithin(box, distance, leaves_);
    const std::size_t room = leaves_.size() * leaf_size + lanes;
    if (room > around_.indices.size()) {
      around_.resize(2 * room);
      squared_.resize(2 * room);
      places_.resize(2 * room);
      ranks_.resize(2 * room);
      nearest_.resize(2 * room);
    }
    // the own ones first, where they are known by their number
    size_ = 0;
    add(points.leaves()[own], box, std::numeric_limits<float>::infinity());
    for (const std::size_t number : leaves_)
      if (number != own)
        add(points.leaves()[number], box, distance);
    fillUp();
  }

  /** Find neighbours of a point of the leaf within a squared radius, as many as there
   * are rows; false: there are fewer.
   * \param[in] leaf that was gathered around
   * \param[in] i which of its points
   * \param[in] unit of the leaf's coordinates
   */
  bool
  find(const Leaf& leaf, int i, float squared_radius, float unit, Neighbourhoods& found)
  {
    const float position[] = {leaf.x[i], leaf.y[i], leaf.z[i]};
    const int n = collect(around_.x.data(), around_.y.data(), around_.z.data(), size_,
                          position, i, squared_radius, squared_.data(), places_.data());
    const int count = static_cast<int>(found.indices.rows());
    if (n < count)
      return false;
    rankNearest(n, count);
    for (int r = 0; r < n; ++r) // without branches, which would be hard to foresee
      nearest_[ranks_[r]] = r;
    int* const indices = &found.indices(0, leaf.indices[i]);
    float* const distances = &found.distances(0, leaf.indices[i]);
    for (int r = 0; r < count; ++r) {
      indices[r] = around_.indices[places_[nearest_[r]]];
      distances[r] = unit * std::sqrt(squared_[nearest_[r]]);
    }
    return true;
  }

private:
  /** Those points of a leaf that lie within a distance of a box. */
  void
  add(const Leaf& leaf, const Eigen::AlignedBox3f& box, float distance)
  {
    for (unsigned int near = whichWithin(leaf, box, distance * distance); near != 0;
         near &= near - 1) {
      const int i = __builtin_ctz(near);
      around_.x[size_] = leaf.x[i];
      around_.y[size_] = leaf.y[i];
      around_.z[size_] = leaf.z[i];
      around_.indices[size_] = leaf.indices[i];
      ++size_;
    }
  }

  /** Up to whole vectors, with points at infinity. */
  void
  fillUp()
  {
    for (; size_ % lanes != 0; ++size_)
      around_.x[size_] = around_.y[size_] = around_.z[size_] =
          std::numeric_limits<float>::infinity();
  }

  /** Rank the nearest of some points, so many of them; the others come after them. */
  void
  rankNearest(int n, int count);

  std::vector<std::size_t> leaves_;
  Columns around_;
  int size_ = 0;
  std::vector<float> squared_;
  std::vector<int> places_, ranks_, nearest_;
};

void
Nearby::rankNearest(int n, int count)
{
  constexpr int few = 96; // ranking takes the square of their number
  if (n <= few) {
    const int filled = roundedUp(n, lanes);
    std::fill(squared_.begin() + n, squared_.begin() + filled,
              std::numeric_limits<float>::infinity());
    rank(squared_.data(), filled, ranks_.data());
    return;
  }
  std::iota(nearest_.begin(), nearest_.begin() + n, 0);
  std::partial_sort(nearest_.begin(), nearest_.begin() + count, nearest_.begin() + n,
                    [&](int a, int b) {
                      return squared_[a] != squared_[b] ? squared_[a] < squared_[b]
                                                        : a < b;
                    });
  std::fill(ranks_.begin(), ranks_.begin() + n, n);
  for (int r = 0; r < count; ++r)
    ranks_[nearest_[r]] = r;
}

/** Find the neighbours of those points of a leaf whose neighbours are not known.
 * \param[in] packed the points, in a unit that is about their extent
 */
void
findNeighbours(const PackedPoints& packed,
               std::size_t number,
               float unit,
               const std::vector<char>& is_known,
               Nearby& nearby,
               Neighbourhoods& found)
{
  const Leaf& leaf = packed.leaves()[number];
  const Eigen::Index last = found.distances.rows() - 1;
  bool is_done[leaf_size];
  for (int i = 0; i < leaf_size; ++i)
    is_done[i] = leaf.indices[i] < 0 || is_known[leaf.indices[i]];
  const auto positionOf = [&leaf](int i) {
    return Eigen::Vector3f(leaf.x[i], leaf.y[i], leaf.z[i]);
  };
  int before = -1;
  float reach = std::max(first_reach * packed.boxOf(number).diagonal().norm(), 1e-4f);
  while (!std::all_of(is_done, is_done + leaf_size, [](bool done) { return done; })) {
    nearby.gather(packed, number, reach);
    for (int i = 0; i < leaf_size; ++i) {
      if (is_done[i])
        continue;
      // rounding aside
      float radius = 0.999f * reach;
      // as many as the one before has are no farther from this one
      if (before >= 0)
        radius = std::min(radius,
                          1.001f * (found.distances(last, leaf.indices[before]) / unit +
                                    (positionOf(i) - positionOf(before)).norm()));
      is_done[i] = nearby.find(leaf, i, radius * radius, unit, found);
      if (is_done[i])
        before = i;
    }
    // in the end, all points are
    reach *= 2.0f;
  }
}

/** Find the neighbours of those points whose neighbours are not known. */
void
findNeighbours(const Points& points,
               unsigned int threads,
               const std::vector<char>& is_known,
               Neighbourhoods& found)
{
  if (found.indices.rows() == 0)
    return;
  // the power of two that is about their extent: squares in it neither overflow nor
  // vanish, and have the same digits
  const float extent = longestEdge(points);
  const float unit = extent > 0.0f ? std::ldexp(1.0f, std::ilogb(extent)) : 1.0f;
  const Points scaled = points / unit;
  const PackedPoints packed(scaled.data(), 3, scaled.cols());
  inParallel(packed.leaves().size(), threads, 16, [&](std::ptrdiff_t leaf) {
    thread_local Nearby nearby;
    findNeighbours(packed, leaf, unit, is_known, nearby, found);
  });
}

} // namespace

Neighbourhoods
neighbourhoodsOf(const Points& points, int neighbours, unsigned int threads)
{
  const Eigen::Index size = points.cols();
  const auto k =
      std::max<Eigen::Index>(0, std::min<Eigen::Index>(neighbours, size - 1));
  Neighbourhoods found{Eigen::MatrixXi(k, size), Eigen::MatrixXf(k, size)};
  findNeighbours(points, threads, std::vector<char>(size, 0), found);
  return found;
}

Neighbourhoods
withoutOthers(const Neighbourhoods& before,
              const std::vector<int>& kept,
              const Points& points,
              unsigned int threads)
{
  std::vector<int> number(before.indices.cols(), -1);
  for (std::size_t i = 0; i < kept.size(); ++i)
    number[kept[i]] = static_cast<int>(i);
  const Eigen::Index size = points.cols();
  const Eigen::Index k = std::min(before.indices.rows(), size - 1);
  Neighbourhoods rest{Eigen::MatrixXi(k, size), Eigen::MatrixXf(k, size)};
  std::vector<char> is_known(size, 1);
  for (Eigen::Index i = 0; i < size; ++i) {
    rest.distances.col(i) = before.distances.col(kept[i]).head(k);
    for (Eigen::Index n = 0; n < k; ++n) {
      rest.indices(n, i) = number[before.indices(n, kept[i])];
      if (rest.indices(n, i) < 0)
        is_known[i] = 0;
    }
  }
  findNeighbours(points, threads, is_known, rest);
  return rest;
}

void
sumUp(const Points& points,
      Eigen::Index point,
      const int* neighbours,
      Eigen::Index k,
      Eigen::Vector3f& sum,
      Eigen::Matrix3f& products)
{
  const float x = points(0, point), y = points(1, point), z = points(2, point);
  float sx = 0, sy = 0, sz = 0, xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;
  for (Eigen::Index n = 0; n < k; ++n) {
    const float* const other = points.data() + 3 * neighbours[n];
    const float dx = other[0] - x, dy = other[1] - y, dz = other[2] - z;
    sx += dx;
    sy += dy;
    sz += dz;
    xx += dx * dx;
    xy += dx * dy;
    xz += dx * dz;
    yy += dy * dy;
    yz += dy * dz;
    zz += dz * dz;
  }
  sum << sx, sy, sz;
  products << xx, xy, xz, xy, yy, yz, xz, yz, zz;
}

Eigen::VectorXf
surfaceVariation(const Points& points,
                 const Neighbourhoods& neighbourhoods,
                 unsigned int threads)
{
  const Eigen::Index size = points.cols(), k = neighbourhoods.indices.rows();
  Eigen::VectorXf variation(size);
  inParallel(size, threads, 500, [&](Eigen::Index i) {
    Eigen::Vector3f sum;
    Eigen::Matrix3f scatter;
    sumUp(points, i, &neighbourhoods.indices(0, i), k, sum, scatter);
    scatter -= sum * sum.transpose() / static_cast<float>(k);
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
