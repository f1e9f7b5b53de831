/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "geometry/distance_field.h"

#include <pcl/registration/kss/detail/stopping.h>

#include <cmath>
#include <limits>

namespace pcl {
namespace kss {
namespace {

constexpr double most_cells = 4e6;

} // namespace

DistanceField::DistanceField(const Points& points, float cell, float margin)
: lower_(points.rowwise().minCoeff().array() - margin)
{
  if (!(cell > 0.0f)) // all points coincide
    cell = 1.0f;
  const Eigen::Vector3f extent =
      (points.rowwise().maxCoeff() - lower_).array() + margin;
  for (;; cell *= 1.25f) {
    const Eigen::Array3d cells = (extent.cast<double>() / cell).array().floor() + 1.0;
    if (cells.prod() <= most_cells) {
      size_ = toIndices(cells, Eigen::Array3i::Constant(static_cast<int>(most_cells)));
      break;
    }
  }
  inverse_edge_ = 1.0f / cell;
  nearest_.assign(numberOfCells(size_), -1);
  distances_.assign(nearest_.size(), std::numeric_limits<float>::max());

  // squared distances first
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    offer(points, cell, cellOf(points.col(i)), static_cast<int>(i));
  for (int round = 0; round < 2; ++round)
    spread(points, cell);
  for (float& distance : distances_)
    distance = std::sqrt(distance);
}

void
DistanceField::offer(const Points& points, float edge, std::size_t cell, int point)
{
  const Eigen::Vector3f at(cell % size_.x(), cell / size_.x() % size_.y(),
                           cell / size_.x() / size_.y());
  const Eigen::Vector3f center = lower_ + edge * (at.array() + 0.5f).matrix();
  const float squared = (points.col(point) - center).squaredNorm();
  if (squared < distances_[cell]) {
    distances_[cell] = squared;
    nearest_[cell] = point;
  }
}

// Every cell that holds a point knows it; then each cell asks the one before it, along
// all axes, to and fro, twice (after P.-E. Danielsson, "Euclidean Distance Mapping",
// 1980): a cell that misses its nearest point has another one hardly farther away. From
// a point's cell the first round alone reaches every cell by steps along x, then y,
// then z, each of which adds an edge at most.
void
DistanceField::spread(const Points& points, float edge)
{
  const auto ask = [&](std::ptrdiff_t cell, std::ptrdiff_t neighbour) {
    const int point = nearest_[neighbour];
    if (point >= 0 && point != nearest_[cell])
      offer(points, edge, cell, point);
  };
  const auto cells = static_cast<std::ptrdiff_t>(nearest_.size());
  std::ptrdiff_t stride = 1; // from cell to cell along the axis
  for (int axis = 0; axis < 3; ++axis) {
    throwIfStopped();
    const std::ptrdiff_t block = stride * size_[axis];
    for (std::ptrdiff_t begin = 0; begin < cells; begin += block) {
      for (std::ptrdiff_t i = begin + stride; i < begin + block; ++i)
        ask(i, i - stride);
      for (std::ptrdiff_t i = begin + block - stride - 1; i >= begin; --i)
        ask(i, i + stride);
    }
    stride = block;
  }
}

} // namespace kss
} // namespace pcl
