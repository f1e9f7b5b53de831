/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace kss_fuzz {

/** \brief An input, taken piece by piece; zeros follow its end. */
class Bytes {
public:
  Bytes(const std::uint8_t* data, std::size_t size)
  : data_(data)
  , size_(size)
  {
  }

  bool
  empty() const
  {
    return size_ == 0;
  }

  std::uint8_t
  byte()
  {
    return take<std::uint8_t>();
  }

  /** \brief A number from 0 to less than a limit. */
  unsigned int
  below(unsigned int limit)
  {
    return byte() % limit;
  }

  bool
  flag()
  {
    return below(2) == 1;
  }

  /** \brief One of some values. */
  template <typename Value, std::size_t number>
  Value
  oneOf(const Value (&values)[number])
  {
    return values[below(number)];
  }

  /** \brief The next bytes, as they are. */
  template <typename Value>
  Value
  take()
  {
    Value value{};
    const std::size_t size = size_ < sizeof value ? size_ : sizeof value;
    if (size > 0)
      std::memcpy(&value, data_, size);
    data_ += size;
    size_ -= size;
    return value;
  }

private:
  const std::uint8_t* data_;
  std::size_t size_;
};

} // namespace kss_fuzz
