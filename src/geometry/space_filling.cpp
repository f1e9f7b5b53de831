/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "geometry/space_filling.h"

#include <pcl/registration/kss/detail/grid_index.h>
#include <pcl/registration/kss/detail/stopping.h>

#include "support/wide_vectors.h"

#include <Eigen/Geometry>

#include <array>
#include <cstdint>
#include <utility>

namespace pcl {
namespace kss {
namespace {

/** Cells along an axis, as a power of two. */
constexpr int bits = 10;

/** Points that are placed along the curve together: loops over them become vectors. */
constexpr int together = 64;

using Numbers = std::array<std::uint32_t, together>;

/** Ten bits with two free ones before each. */
inline std::uint32_t
spreadOut(std::uint32_t number)
{
  number = (number | number << 16) & 0x030000ff;
  number = (number | number << 8) & 0x0300f00f;
  number = (number | number << 4) & 0x030c30c3;
  return (number | number << 2) & 0x09249249;
}

/** The places of cells along Hilbert's curve (J. Skilling, "Programming the Hilbert
 * curve", 2004).
 * \param[in] x of the cells; changed
 * \param[in] y
 * \param[in] z
 * \param[out] places
 */
PCL_KSS_WIDE void
findPlaces(Numbers& x, Numbers& y, Numbers& z, Numbers& places)
{
  for (std::uint32_t bit = 1u << (bits - 1); bit > 1; bit >>= 1) {
    const std::uint32_t below = bit - 1;
    for (Numbers* const coordinates : {&x, &y, &z})
      for (int i = 0; i < together; ++i) {
        // where the bit is set: invert those of x below it; otherwise exchange them
        const std::uint32_t coordinate = (*coordinates)[i];
        const std::uint32_t is_set = coordinate & bit ? ~0u : 0u;
        const std::uint32_t exchanged = (x[i] ^ coordinate) & below & ~is_set;
        x[i] ^= (below & is_set) | exchanged;
        (*coordinates)[i] ^= exchanged;
      }
  }
  for (int i = 0; i < together; ++i) {
    y[i] ^= x[i];
    z[i] ^= y[i];
    std::uint32_t flipped = 0;
    for (std::uint32_t bit = 1u << (bits - 1); bit > 1; bit >>= 1)
      flipped ^= z[i] & bit ? bit - 1 : 0u;
    places[i] = spreadOut(x[i] ^ flipped) << 2 | spreadOut(y[i] ^ flipped) << 1 |
                spreadOut(z[i] ^ flipped);
  }
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

std::vector<std::int32_t>
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
  std::array<std::uint32_t, together> indices;
  Numbers x{}, y{}, z{}, places;
  for (std::size_t i = 0; i < size;) {
    int n = 0;
    for (; i < size && n < together; ++i)
      if (const Eigen::Vector3f point = pointAt(i); point.allFinite()) {
        const Eigen::Array3i cell =
            toIndices(Eigen::Vector3f((point - box.min()) * cells), last);
        x[n] = cell.x();
        y[n] = cell.y();
        z[n] = cell.z();
        indices[n++] = static_cast<std::uint32_t>(i);
      }
    findPlaces(x, y, z, places);
    for (int p = 0; p < n; ++p)
      words.push_back(static_cast<std::uint64_t>(places[p]) << 32 | indices[p]);
  }
  throwIfStopped();
  sortByKeys(words);
  std::vector<std::int32_t> order;
  order.reserve(words.size());
  for (const std::uint64_t word : words)
    order.push_back(static_cast<std::int32_t>(word & 0xffffffff));
  return order;
}

} // namespace kss
} // namespace pcl
