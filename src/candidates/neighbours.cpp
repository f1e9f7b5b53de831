/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "candidates/neighbours.h"

#include <pcl/registration/kss/detail/stopping.h>

#include <algorithm>
#include <limits>

namespace pcl {
namespace kss {

CandidateNeighbours::CandidateNeighbours(const Candidates& candidates,
                                         unsigned int kernel)
: rotations_(candidates.rotations())
, kernel_(kernel)
{
  const auto [nx, ny, nz] = candidates.centers().steps;
  std::size_t stride = 1;
  for (const std::size_t size :
       {static_cast<std::size_t>(nz), static_cast<std::size_t>(ny),
        static_cast<std::size_t>(nx), candidates.scales().size()}) {
    axes_.push_back({size, stride});
    stride *= size;
  }
  row_size_ = stride;
}

std::vector<std::size_t>
CandidateNeighbours::rowsAround(std::size_t row) const
{
  throwIfStopped(); // wide kernels of many rotations take long
  std::vector<std::size_t> rows = rotations_.neighbours(row, kernel_);
  rows.push_back(row);
  return rows;
}

template <typename Better>
void
CandidateNeighbours::spreadInRow(float* row, const Better& better) const
{
  std::vector<float> before(row_size_);
  for (const Axis& axis : axes_) {
    if (axis.size == 1)
      continue;
    std::copy(row, row + row_size_, before.begin());
    const std::size_t block = axis.size * axis.stride;
    for (std::size_t begin = 0; begin < row_size_; begin += block) {
      for (std::size_t i = begin; i < begin + block - axis.stride; ++i)
        row[i] = better(row[i], before[i + axis.stride]);
      for (std::size_t i = begin + axis.stride; i < begin + block; ++i)
        row[i] = better(row[i], before[i - axis.stride]);
    }
  }
}

std::vector<float>
CandidateNeighbours::lowestAround(const std::vector<float>& values,
                                  const std::vector<char>& rows) const
{
  const auto lower = [](float a, float b) { return b < a ? b : a; };
  std::vector<float> spread = values;
  for (std::size_t r = 0; r < rows.size(); ++r)
    spreadInRow(spread.data() + r * row_size_, lower);
  std::vector<float> lowest = spread;
  for (std::size_t r = 0; r < rows.size(); ++r)
    if (rows[r])
      for (const std::size_t n : rowsAround(r)) {
        float* to = lowest.data() + r * row_size_;
        const float* from = spread.data() + n * row_size_;
        for (std::size_t i = 0; i < row_size_; ++i)
          to[i] = lower(to[i], from[i]);
      }
  return lowest;
}

std::vector<float>
CandidateNeighbours::highestAround(const std::vector<float>& values,
                                   const std::vector<char>& rows) const
{
  const auto higher = [](float a, float b) { return b > a ? b : a; };
  std::vector<float> highest(values.size(), std::numeric_limits<float>::lowest());
  std::vector<float> spread(row_size_);
  for (std::size_t r = 0; r < rows.size(); ++r)
    if (rows[r]) {
      std::copy_n(values.begin() + r * row_size_, row_size_, spread.begin());
      spreadInRow(spread.data(), higher);
      for (const std::size_t n : rowsAround(r)) {
        float* to = highest.data() + n * row_size_;
        for (std::size_t i = 0; i < row_size_; ++i)
          to[i] = higher(to[i], spread[i]);
      }
    }
  return highest;
}

} // namespace kss
} // namespace pcl
