/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "lzf.h"

#include <algorithm>
#include <cstring>

namespace tool {

bool
decompressLZF(const std::uint8_t* from,
              std::size_t from_size,
              std::uint8_t* to,
              std::size_t to_size)
{
  const std::uint8_t* const from_end = from + from_size;
  std::uint8_t* const begin = to;
  std::uint8_t* const end = to + to_size;
  const auto left = [](const auto* here, const auto* there) {
    return static_cast<std::size_t>(there - here);
  };
  while (from != from_end) {
    const std::size_t control = *from++;
    if (control < 32) { // bytes as they are
      const std::size_t length = control + 1;
      if (length > left(from, from_end) || length > left(to, end))
        return false;
      std::memcpy(to, from, length);
      from += length;
      to += length;
      continue;
    }
    // bytes that have been before: three bits of their length, 13 of their distance
    std::size_t length = control >> 5;
    if (length == 7) {
      if (from == from_end)
        return false;
      length += *from++;
    }
    length += 2;
    if (from == from_end)
      return false;
    const std::size_t distance = ((control & 31) << 8 | *from++) + 1;
    if (distance > left(begin, to) || length > left(to, end))
      return false;
    for (const std::uint8_t* copied = to - distance; length > 0; --length)
      *to++ = *copied++; // what is copied may be what has just been written
  }
  return to == end;
}

std::vector<std::uint8_t>
compressLZF(const std::uint8_t* from, std::size_t size)
{
  constexpr std::size_t most_literals = 32, farthest = 8192, longest = 264, least = 3;
  constexpr int hash_bits = 15;
  // where three bytes have been last, counted from 1, by a hash of them
  std::vector<std::size_t> last(std::size_t(1) << hash_bits);
  std::vector<std::uint8_t> to;
  to.reserve(size / 2);
  std::size_t literals = 0; // bytes before here that nothing stands for yet
  const auto flush = [&](std::size_t end) {
    while (literals > 0) {
      const std::size_t length = std::min(literals, most_literals);
      to.push_back(static_cast<std::uint8_t>(length - 1));
      to.insert(to.end(), from + (end - literals), from + (end - literals) + length);
      literals -= length;
    }
  };
  std::size_t here = 0;
  while (here < size) {
    std::size_t length = 0, distance = 0;
    if (size - here >= least) {
      const std::uint32_t key =
          from[here] << 16 | from[here + 1] << 8 | std::uint32_t(from[here + 2]);
      std::size_t& before = last[key * 2654435761u >> (32 - hash_bits)];
      if (before > 0 && here + 1 - before <= farthest) {
        distance = here + 1 - before;
        const std::size_t most = std::min(longest, size - here);
        while (length < most && from[here + length] == from[here + length - distance])
          ++length;
      }
      before = here + 1;
    }
    if (length < least) {
      ++literals;
      ++here;
      continue;
    }
    flush(here);
    const std::size_t rest = length - 2, offset = distance - 1;
    to.push_back(
        static_cast<std::uint8_t>(std::min<std::size_t>(rest, 7) << 5 | offset >> 8));
    if (rest >= 7)
      to.push_back(static_cast<std::uint8_t>(rest - 7));
    to.push_back(static_cast<std::uint8_t>(offset));
    here += length;
  }
  flush(size);
  return to;
}

} // namespace tool
