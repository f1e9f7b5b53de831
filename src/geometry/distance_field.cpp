/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "geometry/distance_field.h"

#include <pcl/registration/kss/detail/stopping.h>

#include "geometry/clouds.h"
#include "support/wide_vectors.h"

#include <cmath>
#include <limits>

namespace pcl {
namespace kss {
namespace {

constexpr double most_cells = 4e6;

/** Have cells in a line learn of the points of as many others beside them.
 * \param[in] n how many
 * \param[in] stride from cell to cell
 * \param[in] to_other from a cell to the one that it asks
 * \param[in] centers of the cells along the line
 * \param[in] a where the line is along the second axis
 * \param[in] b the same along the third one
 * \param[in,out] first coordinates of the cells' points, that along the line first,
 * \param[in,out] second
 * \param[in,out] third
 * \param[in,out] squared distances, and
 * \param[in,out] index which they are
 */
PCL_KSS_WIDE void
learn(int n,
      std::ptrdiff_t stride,
      std::ptrdiff_t to_other,
      const float* centers,
      float a,
      float b,
      float* first,
      float* second,
      float* third,
      float* squared,
      int* index)
{
// lines beside each other have no cell in common
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC ivdep
#endif
  for (int i = 0; i < n; ++i) {
    const std::ptrdiff_t own = i * stride, other = own + to_other;
    const float x = first[other], y = second[other], z = third[other];
    const float dx = x - centers[i], dy = y - a, dz = z - b;
    const float distance = dx * dx + dy * dy + dz * dz;
    const bool is_nearer = distance < squared[own];
    squared[own] = is_nearer ? distance : squared[own];
    first[own] = is_nearer ? x : first[own];
    second[own] = is_nearer ? y : second[own];
    third[own] = is_nearer ? z : third[own];
    index[own] = is_nearer ? index[other] : index[own];
  }
}

} // namespace

DistanceField::DistanceField(const Points& points, float cell, float margin)
{
  const Eigen::AlignedBox3f box = boxOf(points);
  lower_ = box.min().array() - margin;
  if (!(cell > 0.0f)) // all points coincide
    cell = 1.0f;
  const Eigen::Vector3f extent = (box.max() - lower_).array() + margin;
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
  std::array<std::vector<float>, 3> places;
  for (std::vector<float>& coordinates : places)
    coordinates.assign(nearest_.size(), std::numeric_limits<float>::infinity());
  for (int i = 0; i < points.cols(); ++i) {
    const Eigen::Array3i at = coordinatesOf(points.col(i));
    const std::size_t cell = cellAt(at);
    const float squared =
        (points.col(i) -
         Eigen::Vector3f(centers_[0][at.x()], centers_[1][at.y()], centers_[2][at.z()]))
            .squaredNorm();
    if (squared < distances_[cell]) {
      distances_[cell] = squared;
      nearest_[cell] = i;
      for (int axis = 0; axis < 3; ++axis)
        places[axis][cell] = points(axis, i);
    }
  }
  for (int round = 0; round < 2; ++round)
    spread(places);
  for (float& distance : distances_)
    distance = std::sqrt(distance);
}

// Every cell that holds a point knows it; then each cell asks the one before it, along
// all axes, to and fro, twice (after P.-E. Danielsson, "Euclidean Distance Mapping",
// 1980): a cell that misses its nearest point has another one hardly farther away. From
// a point's cell the first round alone reaches every cell by steps along x, then y,
// then z, each of which adds an edge at most.
void
DistanceField::spread(std::array<std::vector<float>, 3>& places)
{
  const std::ptrdiff_t strides[] = {1, size_.x(),
                                    static_cast<std::ptrdiff_t>(size_.x()) * size_.y()};
  for (int axis = 0; axis < 3; ++axis) {
    // cells in a line across the axis ask together
    const int line = axis == 0 ? 1 : 0, rest = 3 - axis - line;
    for (int r = 0; r < size_[rest]; ++r) {
      throwIfStopped();
      const auto ask = [&](int at, int other) {
        const std::ptrdiff_t cell = at * strides[axis] + r * strides[rest];
        learn(size_[line], strides[line], (other - at) * strides[axis],
              centers_[line].data(), centers_[axis][at], centers_[rest][r],
              places[line].data() + cell, places[axis].data() + cell,
              places[rest].data() + cell, distances_.data() + cell,
              nearest_.data() + cell);
      };
      for (int i = 1; i < size_[axis]; ++i)
        ask(i, i - 1);
      for (int i = size_[axis] - 2; i >= 0; --i)
        ask(i, i + 1);
    }
  }
}

} // namespace kss
} // namespace pcl
