/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include <pcl/registration/kss/simplification.h>

#include "parallel.h"
#include "take.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <numeric>
#include <unordered_map>

namespace pcl {
namespace kss {
namespace {

using Cell = Eigen::Vector3i;

/** A cell's coordinates in one number: 21 bits each. */
std::uint64_t
keyOf(const Cell& cell)
{
  return (static_cast<std::uint64_t>(cell.x()) << 42) |
         (static_cast<std::uint64_t>(cell.y()) << 21) |
         static_cast<std::uint64_t>(cell.z());
}

/** Cells of one edge over a cloud's bounding box, numbered from 1: their neighbours
 * then have numbers from 0. */
class Cells {
public:
  Cells(const Points& cloud, float edge)
  : lower_(cloud.rowwise().minCoeff())
  , inverse_edge_(1.0f / edge)
  {
  }

  Cell
  of(const Eigen::Vector3f& point) const
  {
    return ((point - lower_) * inverse_edge_).cast<int>().array() + 1;
  }

private:
  Eigen::Vector3f lower_;
  float inverse_edge_;
};

/** L_p of (e6); 1 where all points coincide, so that it can divide. */
float
longestEdge(const Points& cloud)
{
  const float edge =
      (cloud.rowwise().maxCoeff() - cloud.rowwise().minCoeff()).maxCoeff();
  return edge > 0.0f ? edge : 1.0f;
}

/** The edge of a voxel, V_s of (e6). */
float
voxelEdge(const Points& cloud)
{
  const double divisions =
      std::round(std::cbrt(static_cast<double>(cloud.cols())) / 2.0);
  return longestEdge(cloud) / static_cast<float>(std::max(1.0, divisions));
}

/** A box of the cloud, and the samples taken in it. */
struct Voxel {
  Cell cell;
  std::vector<int> points;
  std::vector<int> samples;
  /** squared distance of each sample, when it was taken, to the samples before it */
  std::vector<float> squared_gaps;
};

/** The occupied voxels of a cloud, in the eight rounds in which they may be sampled. */
class VoxelRounds {
public:
  VoxelRounds(const Points& cloud, float edge)
  : cloud_(cloud)
  {
    const Cells cells(cloud, edge);
    for (int i = 0; i < cloud.cols(); ++i) {
      const Cell cell = cells.of(cloud.col(i));
      const auto found = index_.emplace(keyOf(cell), voxels_.size());
      if (found.second)
        voxels_.push_back({cell, {}, {}, {}});
      voxels_[found.first->second].points.push_back(i);
    }
    for (std::size_t v = 0; v < voxels_.size(); ++v) {
      const Cell& cell = voxels_[v].cell;
      rounds_[(cell.x() & 1) | (cell.y() & 1) << 1 | (cell.z() & 1) << 2].push_back(v);
    }
  }

  std::vector<Voxel>&
  voxels()
  {
    return voxels_;
  }

  /** Farthest point sampling in every voxel, up to its quota. */
  void
  sampleQuotas(const std::vector<std::size_t>& quotas, int threads)
  {
    sample([&](std::size_t v) { return quotas[v]; }, -1.0f, threads);
  }

  /** Farthest point sampling in every voxel, until no point of it is farther than \a
   * gap from all samples. */
  void
  sampleApart(float gap, int threads)
  {
    sample([](std::size_t) { return ~std::size_t(0); }, gap * gap, threads);
  }

private:
  template <typename Quota>
  void
  sample(const Quota& quota_of, float squared_gap, int threads)
  {
    for (Voxel& voxel : voxels_) {
      voxel.samples.clear();
      voxel.squared_gaps.clear();
    }
    for (const auto& round : rounds_) {
      const auto size = static_cast<std::ptrdiff_t>(round.size());
#pragma omp parallel for schedule(dynamic, 16) num_threads(threads)
      for (std::ptrdiff_t i = 0; i < size; ++i)
        sampleVoxel(voxels_[round[i]], quota_of(round[i]), squared_gap);
    }
  }

  /** Samples that earlier rounds took in the 26 voxels around. */
  std::vector<int>
  samplesAround(const Voxel& voxel) const
  {
    std::vector<int> samples;
    for (int dx = -1; dx <= 1; ++dx)
      for (int dy = -1; dy <= 1; ++dy)
        for (int dz = -1; dz <= 1; ++dz) {
          const auto found = index_.find(keyOf(voxel.cell + Cell(dx, dy, dz)));
          if (found == index_.end() || &voxels_[found->second] == &voxel)
            continue;
          const auto& others = voxels_[found->second].samples;
          samples.insert(samples.end(), others.begin(), others.end());
        }
    return samples;
  }

  void
  sampleVoxel(Voxel& voxel, std::size_t quota, float squared_gap) const
  {
    const std::size_t n = voxel.points.size();
    Points points(3, n);
    for (std::size_t i = 0; i < n; ++i)
      points.col(i) = cloud_.col(voxel.points[i]);

    Eigen::RowVectorXf squared =
        Eigen::RowVectorXf::Constant(n, std::numeric_limits<float>::max());
    for (const int sample : samplesAround(voxel))
      squared = squared.cwiseMin(
          (points.colwise() - cloud_.col(sample)).colwise().squaredNorm());

    // with nothing sampled around, the point in the middle of the voxel comes first
    Eigen::Index next;
    float farthest = squared.maxCoeff(&next);
    if (farthest == std::numeric_limits<float>::max()) {
      const Eigen::Vector3f middle = points.rowwise().mean();
      (points.colwise() - middle).colwise().squaredNorm().minCoeff(&next);
    }
    while (voxel.samples.size() < quota && farthest > squared_gap) {
      voxel.samples.push_back(voxel.points[next]);
      voxel.squared_gaps.push_back(farthest);
      const Eigen::Vector3f sample = points.col(next);
      squared = squared.cwiseMin((points.colwise() - sample).colwise().squaredNorm());
      squared[next] = -1.0f; // taken, which a copy of it is not
      farthest = squared.maxCoeff(&next);
    }
  }

  const Points& cloud_;
  std::vector<Voxel> voxels_;
  std::unordered_map<std::uint64_t, std::size_t> index_;
  std::array<std::vector<std::size_t>, 8> rounds_;
};

/** |P_v'| of (e5), by largest remainder: whole numbers that add up to k and favour no
 * voxel for its place. */
std::vector<std::size_t>
quotasByCount(const std::vector<Voxel>& voxels, std::size_t points, std::size_t k)
{
  std::vector<std::size_t> quotas(voxels.size());
  std::vector<std::pair<std::size_t, std::size_t>> remainders; // largest first
  std::size_t given = 0;
  for (std::size_t v = 0; v < voxels.size(); ++v) {
    const std::size_t share = voxels[v].points.size() * k;
    quotas[v] = share / points;
    given += quotas[v];
    remainders.emplace_back(points - share % points, v);
  }
  std::sort(remainders.begin(), remainders.end());
  for (std::size_t r = 0; given < k; ++r, ++given)
    ++quotas[remainders[r].second];
  return quotas;
}

/** The first point of each cell, of cells just large enough for about so many points to
 * come out; more than \a least and, unless a point far away from all others makes all
 * cells too large, fewer than \a most. */
std::vector<int>
onePerCell(const Points& cloud, std::size_t least, std::size_t most)
{
  // The points of a surface grow with the inverse square of the edge; of a line or a
  // filled body a little otherwise, hence a few rounds.
  const float aim = std::sqrt(static_cast<float>(least) * most);
  float edge = longestEdge(cloud) / std::sqrt(aim);
  std::vector<int> kept;
  for (int round = 0; round < 8; ++round) {
    edge = std::max(edge, longestEdge(cloud) / (1 << 20));
    const Cells cells(cloud, edge);
    std::unordered_map<std::uint64_t, int> first;
    first.reserve(2 * most);
    kept.clear();
    for (int i = 0; i < cloud.cols(); ++i)
      if (first.emplace(keyOf(cells.of(cloud.col(i))), i).second)
        kept.push_back(i);
    if (kept.size() >= least && kept.size() <= most)
      break;
    edge *= std::sqrt(static_cast<float>(kept.size()) / aim);
  }
  return kept;
}

/** Several times k points, which is as much as an even sampling by area can use: it
 * makes the rest of the work independent of the cloud's size. */
Points
thin(const Points& cloud, unsigned int k)
{
  const std::size_t wanted = 8 * static_cast<std::size_t>(k);
  if (static_cast<std::size_t>(cloud.cols()) <= 2 * wanted)
    return cloud;
  const std::vector<int> kept = onePerCell(cloud, wanted, 3 * wanted);
  return kept.size() < wanted ? cloud : take(cloud, kept);
}

/** The samples that lie at least \a gap apart; voxels are made large enough for the gap
 * to reach no farther than the adjacent ones. */
std::vector<std::pair<float, int>>
samplesApart(const Points& cloud, float gap, int threads)
{
  VoxelRounds rounds(cloud, std::max(voxelEdge(cloud), gap));
  rounds.sampleApart(gap, threads);
  std::vector<std::pair<float, int>> samples;
  for (const Voxel& voxel : rounds.voxels())
    for (std::size_t i = 0; i < voxel.samples.size(); ++i)
      samples.emplace_back(voxel.squared_gaps[i], voxel.samples[i]);
  return samples;
}

/** k samples at a common distance: the distance is searched until hardly more than k
 * come out, and those that came closest to others are left out. */
std::vector<int>
sampleEvenly(const Points& cloud, std::size_t k, int threads)
{
  float gap = longestEdge(cloud) / std::sqrt(static_cast<float>(k));
  float too_wide = std::numeric_limits<float>::infinity(), narrow = 0.0f;
  std::vector<std::pair<float, int>> best;
  for (int round = 0; round < 24; ++round) {
    auto samples = samplesApart(cloud, gap, threads);
    const auto count = static_cast<float>(samples.size());
    if (samples.size() >= k) {
      narrow = gap;
      if (best.empty() || samples.size() < best.size())
        best = std::move(samples);
      if (best.size() <= k + k / 50)
        break;
    }
    else
      too_wide = gap;
    // aim a little above k, within what is known
    const float aim = gap * std::sqrt(count / (1.01f * static_cast<float>(k)));
    gap = aim > narrow && aim < too_wide ? aim
          : std::isinf(too_wide)         ? 1.5f * gap
                                         : 0.5f * (narrow + too_wide);
  }
  if (best.size() < k)
    best = samplesApart(cloud, 0.0f, threads);
  std::vector<int> indices;
  if (best.size() > k) {
    std::nth_element(best.begin(), best.begin() + k, best.end(), std::greater<>());
    best.resize(k);
  }
  for (const auto& sample : best)
    indices.push_back(sample.second);
  std::sort(indices.begin(), indices.end());
  return indices;
}

/** A cloud of no more points than these is taken as it is: evenness would leave too
 * little of it to tell a shape by. */
constexpr std::size_t fewest_samples = 64;

/** How far the points of a cloud lie apart where they are sparse: of even samples, nine
 * in ten have another point within this distance. */
float
spacingWhereSparse(const Points& cloud, int threads)
{
  const std::size_t probes = std::min<std::size_t>(256, cloud.cols());
  std::vector<float> nearest;
  for (const int probe : sampleEvenly(cloud, probes, threads)) {
    Eigen::RowVectorXf squared =
        (cloud.colwise() - cloud.col(probe)).colwise().squaredNorm();
    squared[probe] = std::numeric_limits<float>::max();
    nearest.push_back(squared.minCoeff());
  }
  const auto ninth = nearest.begin() + nearest.size() * 9 / 10;
  std::nth_element(nearest.begin(), ninth, nearest.end());
  return std::sqrt(*ninth);
}

} // namespace

unsigned int
evenSampleSize(const Points& cloud, unsigned int k, unsigned int threads)
{
  const Points thinned = thin(cloud, k);
  const int n = threadCount(threads);
  const auto apart = samplesApart(thinned, spacingWhereSparse(thinned, n), n).size();
  return static_cast<unsigned int>(
      std::min<std::size_t>(k, std::max(apart, fewest_samples)));
}

Points
simplify(const Points& cloud, unsigned int k, Density density, unsigned int threads)
{
  const int n = threadCount(threads);
  if (density == Density::UNIFORM) {
    const Points thinned = thin(cloud, k);
    return take(thinned, sampleEvenly(thinned, k, n));
  }
  const std::size_t points = cloud.cols();
  VoxelRounds rounds(cloud, voxelEdge(cloud));
  const std::size_t samples = std::min<std::size_t>(k, points);
  rounds.sampleQuotas(quotasByCount(rounds.voxels(), points, samples), n);
  std::vector<int> indices;
  for (const Voxel& voxel : rounds.voxels())
    indices.insert(indices.end(), voxel.samples.begin(), voxel.samples.end());
  return take(cloud, indices);
}

Points
thinned(const Points& cloud, unsigned int most)
{
  if (cloud.cols() <= most)
    return cloud;
  const Points rest = take(cloud, onePerCell(cloud, most / 2, most));
  return rest.cols() <= most ? rest : simplify(rest, most, Density::UNIFORM, 1);
}

Points
inFarthestOrder(const Points& cloud)
{
  const Eigen::Vector3f middle = cloud.rowwise().mean();
  Eigen::Index next;
  (cloud.colwise() - middle).colwise().squaredNorm().minCoeff(&next);
  Eigen::RowVectorXf squared =
      Eigen::RowVectorXf::Constant(cloud.cols(), std::numeric_limits<float>::max());
  Points ordered(3, cloud.cols());
  for (Eigen::Index i = 0; i < cloud.cols(); ++i) {
    const Eigen::Vector3f point = cloud.col(next);
    ordered.col(i) = point;
    squared = squared.cwiseMin((cloud.colwise() - point).colwise().squaredNorm());
    squared[next] = -1.0f; // taken, which a copy of it is not
    squared.maxCoeff(&next);
  }
  return ordered;
}

} // namespace kss
} // namespace pcl
