/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "lzf.h"

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

} // namespace tool
