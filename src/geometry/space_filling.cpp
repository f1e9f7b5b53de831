/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "geometry/space_filling.h"

#include <pcl/registration/kss/detail/grid_index.h>
#include <pcl/registration/kss/detail/stopping.h>

#include <Eigen/Geometry>

#include <array>
#include <cstdint>
#include <utility>

namespace pcl {
namespace kss {
namespace {

/** Cells along an axis, as a power of two. */
constexpr int bits = 10;

/** Ten bits with two free ones before each. */
std::uint64_t
spreadOut(std::uint64_t number)
{
  number = (number | number << 16) & 0x030000ff;
  number = (number | number << 8) & 0x0300f00f;
  number = (number | number << 4) & 0x030c30c3;
  return (number | number << 2) & 0x09249249;
}

/** The place of a cell along Hilbert's curve (J. Skilling, "Programming the Hilbert
 * curve", 2004). */
std::uint64_t
placeOf(const Eigen::Array3i& cell)
{
  unsigned int x[] = {static_cast<unsigned int>(cell.x()),
                      static_cast<unsigned int>(cell.y()),
                      static_cast<unsigned int>(cell.z())};
  for (unsigned int bit = 1u << (bits - 1); bit > 1; bit >>= 1) {
    const unsigned int below = bit - 1;
    for (unsigned int& coordinate : x) {
      // where the bit is set: invert those of x below it; otherwise exchange them
      const unsigned int is_set = coordinate & bit ? ~0u : 0u;
      const unsigned int exchanged = (x[0] ^ coordinate) & below & ~is_set;
      x[0] ^= (below & is_set) | exchanged;
      coordinate ^= exchanged;
    }
  }
  x[1] ^= x[0];
  x[2] ^= x[1];
  unsigned int flipped = 0;
  for (unsigned int bit = 1u << (bits - 1); bit > 1; bit >>= 1)
    if (x[2] & bit)
      flipped ^= bit - 1;
  return spreadOut(x[0] ^ flipped) << 2 | spreadOut(x[1] ^ flipped) << 1 |
         spreadOut(x[2] ^ flipped);
}

/** Sort by the upper half of the words, which has 3 x bits bits. */
void
sortByKeys(std::vector<std::uint64_t>& words)
{
  constexpr std::size_t buckets = std::size_t(1) << bits;
  std::vector<std::uint64_t> sorted(words.size());
  for (int digit = 0; digit < 3; ++digit) {
    const int shift = 32 + digit * bits;
    std::array<std::size_t, buckets + 1> begin{};
    for (const std::uint64_t word : words)
      ++begin[(word >> shift & (buckets - 1)) + 1];
    for (std::size_t b = 0; b < buckets; ++b)
      begin[b + 1] += begin[b];
    for (const std::uint64_t word : words)
      sorted[begin[word >> shift & (buckets - 1)]++] = word;
    words.swap(sorted);
  }
}

} // namespace

std::vector<index_t>
alongSpace(const float* first, std::size_t stride, std::size_t size)
{
  const auto pointAt = [=](std::size_t i) {
    return Eigen::Vector3f(first + i * stride);
  };
  Eigen::AlignedBox3f box;
  for (std::size_t i = 0; i < size; ++i)
    if (pointAt(i).allFinite())
      box.extend(pointAt(i));
  const float longest = box.isEmpty() ? 0.0f : box.sizes().maxCoeff();
  const float cells = longest > 0.0f ? (1 << bits) / longest : 0.0f;
  const Eigen::Array3i last = Eigen::Array3i::Constant((1 << bits) - 1);
  std::vector<std::uint64_t> words;
  words.reserve(size);
  for (std::size_t i = 0; i < size; ++i) {
    const Eigen::Vector3f point = pointAt(i);
    if (!point.allFinite())
      continue;
    const Eigen::Array3i cell =
        toIndices(Eigen::Vector3f((point - box.min()) * cells), last);
    const std::uint64_t key = placeOf(cell);
    words.push_back(key << 32 | i);
  }
  throwIfStopped();
  sortByKeys(words);
  std::vector<index_t> order;
  order.reserve(words.size());
  for (const std::uint64_t word : words)
    order.push_back(static_cast<index_t>(word & 0xffffffff));
  return order;
}

} // namespace kss
} // namespace pcl
