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

  for (int axis = 0; axis < 3; ++axis)
    for (int i = 0; i < size_[axis]; ++i)
      centers_[axis].push_back(lower_[axis] + cell * (static_cast<float>(i) + 0.5f));

  // squared distances first
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const Eigen::Array3i at = coordinatesOf(points.col(i));
    offer(points, cellAt(at),
          {centers_[0][at.x()], centers_[1][at.y()], centers_[2][at.z()]},
          static_cast<int>(i));
  }
  for (int round = 0; round < 2; ++round)
    spread(points);
  for (float& distance : distances_)
    distance = std::sqrt(distance);
}

void
DistanceField::offer(const Points& points,
                     std::size_t cell,
                     const Eigen::Vector3f& center,
                     int point)
{
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
DistanceField::spread(const Points& points)
{
  std::ptrdiff_t stride = 1; // from cell to cell along the axis
  for (int axis = 0; axis < 3; ++axis) {
    throwIfStopped();
    // the cells with a coordinate ask those with the one before it, or behind it
    const auto ask = [&](int coordinate, int other) {
      Eigen::Array3i first = Eigen::Array3i::Zero(), last = size_.array() - 1;
      first[axis] = last[axis] = coordinate;
      const std::ptrdiff_t to_other = (other - coordinate) * stride;
      for (int z = first.z(); z <= last.z(); ++z)
        for (int y = first.y(); y <= last.y(); ++y) {
          auto cell = static_cast<std::ptrdiff_t>(cellAt({first.x(), y, z}));
          for (int x = first.x(); x <= last.x(); ++x, ++cell) {
            const int point = nearest_[cell + to_other];
            if (point >= 0 && point != nearest_[cell])
              offer(points, cell, {centers_[0][x], centers_[1][y], centers_[2][z]},
                    point);
          }
        }
    };
    for (int i = 1; i < size_[axis]; ++i)
      ask(i, i - 1);
    for (int i = size_[axis] - 2; i >= 0; --i)
      ask(i, i + 1);
    stride *= size_[axis];
  }
}

} // namespace kss
} // namespace pcl
