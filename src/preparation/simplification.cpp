/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "preparation/simplification.h"

#include <pcl/registration/kss/detail/stopping.h>

#include "geometry/cell_grid.h"
#include "geometry/clouds.h"
#include "geometry/take.h"
#include "support/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <random>
#include <vector>

namespace pcl {
namespace kss {
namespace {

/** L_p of (e6); 1 where all points coincide, so that it can divide. */
float
edgeToDivide(const Eigen::AlignedBox3f& box)
{
  const float edge = box.sizes().maxCoeff();
  return edge > 0.0f ? edge : 1.0f;
}

/** The edge of a voxel, V_s of (e6). */
float
voxelEdge(const Points& cloud)
{
  const double divisions =
      std::round(std::cbrt(static_cast<double>(cloud.cols())) / 2.0);
  return edgeToDivide(boxOf(cloud)) / static_cast<float>(std::max(1.0, divisions));
}

/** A box of the cloud, and the samples taken in it. */
struct Voxel {
  Cell cell;
  std::vector<int> points;
  std::vector<int> samples;
};

/** The occupied voxels of a cloud, in the eight rounds in which they may be sampled. */
class VoxelRounds {
public:
  VoxelRounds(const Points& cloud, float edge)
  : cloud_(cloud)
  , grid_(cloud, edge)
  {
    for (std::size_t v = 0; v < grid_.occupied().size(); ++v) {
      const Cell& cell = grid_.occupied()[v];
      const auto points = grid_.order().begin();
      const int voxel = static_cast<int>(v);
      voxels_.push_back(
          {cell, {points + grid_.begin(voxel), points + grid_.begin(voxel + 1)}, {}});
      rounds_[(cell.x() & 1) | (cell.y() & 1) << 1 | (cell.z() & 1) << 2].push_back(v);
    }
  }

  const std::vector<Voxel>&
  voxels() const
  {
    return voxels_;
  }

  /** Farthest point sampling in every voxel, up to its quota. */
  void
  sample(const std::vector<std::size_t>& quotas, unsigned int threads)
  {
    for (const auto& round : rounds_) {
      inParallel(round.size(), threads, 64, [&](std::ptrdiff_t i) {
        sampleVoxel(voxels_[round[i]], quotas[round[i]]);
      });
    }
  }

private:
  /** Samples that earlier rounds took in the 26 voxels around. */
  std::vector<int>
  samplesAround(const Voxel& voxel) const
  {
    std::vector<int> samples;
    for (int dx = -1; dx <= 1; ++dx)
      for (int dy = -1; dy <= 1; ++dy)
        for (int dz = -1; dz <= 1; ++dz) {
          const int found = grid_.find(voxel.cell + Cell(dx, dy, dz));
          if (found < 0 || &voxels_[found] == &voxel)
            continue;
          const auto& others = voxels_[found].samples;
          samples.insert(samples.end(), others.begin(), others.end());
        }
    return samples;
  }

  void
  sampleVoxel(Voxel& voxel, std::size_t quota) const
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
    if (squared.maxCoeff(&next) == std::numeric_limits<float>::max()) {
      const Eigen::Vector3f middle = points.rowwise().mean();
      (points.colwise() - middle).colwise().squaredNorm().minCoeff(&next);
    }
    while (voxel.samples.size() < quota) {
      voxel.samples.push_back(voxel.points[next]);
      const Eigen::Vector3f sample = points.col(next);
      squared = squared.cwiseMin((points.colwise() - sample).colwise().squaredNorm());
      squared[next] = -1.0f; // taken, which a copy of it is not
      squared.maxCoeff(&next);
    }
  }

  const Points& cloud_;
  CellGrid grid_;
  std::vector<Voxel> voxels_;
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

/** So many of the points, voxel by voxel. */
std::vector<int>
byQuotas(const Points& cloud, std::size_t samples, unsigned int threads)
{
  VoxelRounds rounds(cloud, voxelEdge(cloud));
  rounds.sample(quotasByCount(rounds.voxels(), cloud.cols(), samples), threads);
  std::vector<int> indices;
  for (const Voxel& voxel : rounds.voxels())
    indices.insert(indices.end(), voxel.samples.begin(), voxel.samples.end());
  return indices;
}

/** The first so many of a random order of the points. */
std::vector<int>
atRandom(std::size_t points, std::size_t samples)
{
  std::vector<int> indices(points);
  std::iota(indices.begin(), indices.end(), 0);
  std::mt19937_64 generator(0);
  for (std::size_t i = 0; i < samples; ++i)
    std::swap(indices[i], indices[i + generator() % (points - i)]);
  indices.resize(samples);
  return indices;
}

/** The first point of each cell; every so-manieth point takes part. */
std::vector<int>
onePerCell(const Points& cloud,
           const CellLattice& cells,
           std::size_t expected,
           std::ptrdiff_t stride)
{
  KeyTable table(expected);
  std::vector<int> kept;
  // many at once: slots of the table are on their way while others are looked at
  constexpr int many = 64;
  std::array<std::uint64_t, many> keys;
  for (std::ptrdiff_t begin = 0; begin < cloud.cols(); begin += many * stride) {
    throwIfStopped();
    const std::ptrdiff_t left = (cloud.cols() - begin + stride - 1) / stride;
    const auto n = static_cast<int>(std::min<std::ptrdiff_t>(many, left));
    for (int i = 0; i < n; ++i) {
      keys[i] = keyOf(cells.of(cloud.col(begin + i * stride)));
      table.prefetch(keys[i]);
    }
    for (int i = 0; i < n; ++i)
      if (table.add(keys[i]) == static_cast<int>(kept.size()))
        kept.push_back(static_cast<int>(begin + i * stride));
  }
  return kept;
}

/** The first point of each cell, of cells just large enough for about so many points to
 * come out; more than \a least and, unless a point far away from all others makes all
 * cells too large, fewer than \a most. */
std::vector<int>
onePerCell(const Points& cloud, std::size_t least, std::size_t most)
{
  // The points of a surface grow with the inverse square of the edge; of a line or a
  // filled body a little otherwise, hence a few rounds. A dozen points for each cell
  // are enough to find the edge.
  const auto size = static_cast<std::size_t>(cloud.cols());
  const auto stride =
      static_cast<std::ptrdiff_t>(std::max<std::size_t>(1, size / (12 * most)));
  const float aim = std::sqrt(static_cast<float>(least) * most);
  const Eigen::AlignedBox3f box = boxOf(cloud);
  const float longest = edgeToDivide(box);
  float edge = longest / std::sqrt(aim);
  std::vector<int> kept;
  for (int round = 0; round < 8; ++round) {
    edge = std::max(edge, longest / CellLattice::most);
    kept = onePerCell(cloud, {box, edge}, most, stride);
    if (kept.size() >= least && kept.size() <= most)
      break;
    edge *= std::sqrt(static_cast<float>(kept.size()) / aim);
  }
  return stride == 1 ? kept : onePerCell(cloud, {box, edge}, most, 1);
}

/** Points whose neighbours tell how sparse a cloud can be. */
constexpr std::size_t spacing_probes = 256;

} // namespace

std::size_t
evenSampleSize(const FarthestOrder& order, const Neighbourhoods& neighbourhoods)
{
  if (neighbourhoods.distances.rows() == 0)
    return order.indices.size();
  // How far points lie apart where they are sparse: of even samples, nine in ten have
  // another point within this distance.
  std::vector<float> nearest;
  for (std::size_t i = 0; i < std::min(spacing_probes, order.indices.size()); ++i)
    nearest.push_back(neighbourhoods.distances(0, order.indices[i]));
  const auto ninth = nearest.begin() + nearest.size() * 9 / 10;
  std::nth_element(nearest.begin(), ninth, nearest.end());
  const auto closer = std::partition_point(order.gaps.begin(), order.gaps.end(),
                                           [&](float gap) { return gap > *ninth; });
  const std::size_t apart = closer - order.gaps.begin();
  return std::min(order.indices.size(), std::max(apart, fewest_samples));
}

Points
simplify(const Points& cloud, std::size_t k, Density density, unsigned int threads)
{
  if (density == Density::UNIFORM)
    return take(cloud, inFarthestOrder(cloud, k).indices);
  const std::size_t samples = std::min<std::size_t>(k, cloud.cols());
  const Points simplified =
      take(cloud, density == Density::PAPER ? byQuotas(cloud, samples, threads)
                                            : atRandom(cloud.cols(), samples));
  return take(simplified, inFarthestOrder(simplified, samples).indices);
}

Points
thinned(const Points& cloud, std::size_t most)
{
  if (static_cast<std::size_t>(cloud.cols()) <= most)
    return cloud;
  const std::size_t least = most / 2;
  std::vector<int> kept = onePerCell(cloud, least, most);
  // a point far away from all others makes all cells too large
  const std::size_t step = cloud.cols() / most;
  if (kept.size() < least)
    for (std::size_t i = 0; i < most; ++i)
      kept.push_back(static_cast<int>(i * step));
  const Points rest = take(cloud, kept);
  return static_cast<std::size_t>(rest.cols()) <= most
             ? rest
             : take(rest, inFarthestOrder(rest, most).indices);
}

} // namespace kss
} // namespace pcl
