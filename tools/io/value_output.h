/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "geometry.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <ostream>
#include <type_traits>

namespace tool {

/** \brief Writes the values of a PLY or PCD file one by one: as text, one element a
 * line, or as bytes.
 */
class ValueOutput {
public:
  ValueOutput(std::ostream& stream, Storage storage)
  : stream_(stream)
  , storage_(storage)
  {
  }

  template <typename Number>
  void
  write(Number number)
  {
    if (storage_ == Storage::TEXT)
      return writeText(number);
    char bytes[sizeof number];
    std::memcpy(bytes, &number, sizeof number);
    if (storage_ == Storage::BINARY_BIG)
      std::reverse(bytes, bytes + sizeof number);
    stream_.write(bytes, sizeof number);
  }

  void
  endElement()
  {
    if (storage_ == Storage::TEXT)
      stream_.put('\n');
    is_first_ = true;
  }

private:
  template <typename Number>
  void
  writeText(Number number)
  {
    if constexpr (std::is_floating_point_v<Number>)
      number = std::isnan(number) ? std::abs(number) : number; // no "-nan"
    char digits[32];
    char* end = digits;
    if (!is_first_)
      *end++ = ' ';
    is_first_ = false;
    if constexpr (sizeof number == 1) // no letter
      end = std::to_chars(end, digits + sizeof digits, static_cast<int>(number)).ptr;
    else
      end = std::to_chars(end, digits + sizeof digits, number).ptr;
    stream_.write(digits, end - digits);
  }

  std::ostream& stream_;
  Storage storage_;
  bool is_first_ = true;
};

} // namespace tool
