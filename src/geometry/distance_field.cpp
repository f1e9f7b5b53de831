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

  // Squared distances first. Every cell that holds a point knows it; then each cell
  // asks the one before it, along all axes, to and fro, twice (after P.-E. Danielsson,
  // "Euclidean Distance Mapping", 1980): a cell that misses its nearest point has
  // another one hardly farther away. From a point's cell the first round alone reaches
  // every cell by steps along x, then y, then z, each of which adds an edge at most.
  const auto offer = [&](std::size_t index, const Eigen::Vector3f& center, int point) {
    const float squared = (points.col(point) - center).squaredNorm();
    if (squared < distances_[index]) {
      distances_[index] = squared;
      nearest_[index] = point;
    }
  };
  const auto centerOf = [&](int x, int y, int z) -> Eigen::Vector3f {
    return lower_ + cell * Eigen::Vector3f(x + 0.5f, y + 0.5f, z + 0.5f);
  };
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const std::size_t index = cellOf(points.col(i));
    const int x = index % size_.x(), y = index / size_.x() % size_.y(),
              z = index / size_.x() / size_.y();
    offer(index, centerOf(x, y, z), i);
  }
  const auto ask = [&](std::ptrdiff_t index, std::ptrdiff_t neighbour) {
    const int point = nearest_[neighbour];
    if (point < 0 || point == nearest_[index])
      return;
    const int x = static_cast<int>(index % size_.x());
    const int y = static_cast<int>(index / size_.x() % size_.y());
    const int z = static_cast<int>(index / size_.x() / size_.y());
    offer(index, centerOf(x, y, z), point);
  };
  const auto cells = static_cast<std::ptrdiff_t>(nearest_.size());
  for (int round = 0; round < 2; ++round) {
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
  for (float& distance : distances_)
    distance = std::sqrt(distance);
}

} // namespace kss
} // namespace pcl
