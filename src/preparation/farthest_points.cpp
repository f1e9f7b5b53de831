/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "preparation/farthest_points.h"

#include <pcl/registration/kss/detail/stopping.h>

#include "geometry/cell_grid.h"
#include "geometry/clouds.h"
#include "support/wide_vectors.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl {
namespace kss {
namespace {

/** Points of a block: enough to fill vectors, few enough to be passed over often. */
constexpr float block_points = 48.0f;

/** Points close together: when a sample has been taken too far away to be the nearest
 * of any of them, nothing changes. */
struct Block {
  Eigen::Vector3f center;
  float radius;
  int begin, end;
  float farthest; // the largest squared distance to the samples
  int at;         // and whose that is
};

/** Bring squared distances down to those from a sample; the index of the largest. */
PCL_KSS_WIDE int
bringDown(const float* x,
          const float* y,
          const float* z,
          const float* sample,
          int begin,
          int end,
          float* squared)
{
  const float sx = sample[0], sy = sample[1], sz = sample[2];
  float largest = -1.0f;
  for (int i = begin; i < end; ++i) {
    const float d = (x[i] - sx) * (x[i] - sx) + (y[i] - sy) * (y[i] - sy) +
                    (z[i] - sz) * (z[i] - sz);
    squared[i] = d < squared[i] ? d : squared[i];
  }
  int at = begin;
  for (int i = begin; i < end; ++i)
    if (squared[i] > largest) {
      largest = squared[i];
      at = i;
    }
  return at;
}

} // namespace

FarthestOrder
inFarthestOrder(const Points& cloud, std::size_t most)
{
  const auto size = static_cast<std::size_t>(cloud.cols());
  FarthestOrder order;
  const float longest = longestEdge(cloud);
  const float edge = longest > 0.0f ? longest * std::sqrt(block_points / size) : 1.0f;
  const CellGrid grid(cloud, std::max(edge, longest / CellLattice::most));
  Eigen::MatrixX3f sorted(size, 3);
  for (std::size_t i = 0; i < size; ++i)
    sorted.row(i) = cloud.col(grid.order()[i]).transpose();
  std::vector<float> squared(size, std::numeric_limits<float>::max());

  std::vector<Block> blocks;
  for (std::size_t c = 0; c < grid.occupied().size(); ++c) {
    Block block;
    block.begin = grid.begin(static_cast<int>(c));
    block.end = grid.begin(static_cast<int>(c) + 1);
    const auto points = sorted.middleRows(block.begin, block.end - block.begin);
    block.center = 0.5f * (points.colwise().maxCoeff() + points.colwise().minCoeff());
    block.radius =
        (points.rowwise() - block.center.transpose()).rowwise().norm().maxCoeff();
    block.farthest = std::numeric_limits<float>::max();
    block.at = block.begin;
    blocks.push_back(block);
  }

  const Eigen::RowVector3f middle = sorted.colwise().mean();
  Eigen::Index next;
  (sorted.rowwise() - middle).rowwise().squaredNorm().minCoeff(&next);
  float gap = std::numeric_limits<float>::infinity();
  while (order.indices.size() < std::min(most, size)) {
    throwIfStopped();
    order.indices.push_back(grid.order()[next]);
    order.gaps.push_back(gap);
    const Eigen::Vector3f sample = sorted.row(next);
    squared[next] = -1.0f; // taken, which a copy of it is not
    float farthest = -1.0f;
    for (Block& block : blocks) {
      // rounding must not hide a change
      const float apart =
          0.9999f * (sample - block.center).norm() - 1.0001f * block.radius;
      const bool holds_sample = next >= block.begin && next < block.end;
      if (holds_sample || apart < 0.0f || apart * apart < block.farthest) {
        block.at =
            bringDown(sorted.col(0).data(), sorted.col(1).data(), sorted.col(2).data(),
                      sample.data(), block.begin, block.end, squared.data());
        block.farthest = squared[block.at];
      }
      if (block.farthest > farthest) {
        farthest = block.farthest;
        next = block.at;
      }
    }
    gap = std::sqrt(std::max(0.0f, farthest));
  }
  return order;
}

} // namespace kss
} // namespace pcl
