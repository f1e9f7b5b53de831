/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "text_encoding.h"

#include <cstdint>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>

namespace tool {
namespace {

enum class Order { NONE, LITTLE, BIG };

bool
isASCII(char byte)
{
  return (byte >= ' ' && byte <= '~') || (byte >= '\t' && byte <= '\r');
}

/** By the mark at the start, or by which bytes of most characters, which are of ASCII,
 * are zeros. */
Order
orderOf(std::string_view start)
{
  if (start.substr(0, 4) == std::string_view("\xFF\xFE\0\0", 4) ||
      start.substr(0, 4) == std::string_view("\0\0\xFE\xFF", 4))
    throw std::runtime_error("is text in UTF-32; save it in UTF-8");
  if (start.substr(0, 2) == "\xFF\xFE")
    return Order::LITTLE;
  if (start.substr(0, 2) == "\xFE\xFF")
    return Order::BIG;
  std::size_t little = 0, big = 0;
  for (std::size_t i = 0; i + 1 < start.size(); i += 2) {
    little += isASCII(start[i]) && start[i + 1] == '\0';
    big += start[i] == '\0' && isASCII(start[i + 1]);
  }
  const std::size_t units = start.size() / 2;
  const auto are_most = [&](std::size_t number) {
    return units >= 4 && 4 * number >= 3 * units;
  };
  return are_most(little) ? Order::LITTLE : are_most(big) ? Order::BIG : Order::NONE;
}

void
append(std::string& text, std::uint32_t character)
{
  const auto add = [&](std::uint32_t byte) { text += static_cast<char>(byte); };
  if (character < 0x80)
    return add(character);
  if (character < 0x800)
    add(0xC0 | character >> 6);
  else {
    if (character < 0x10000)
      add(0xE0 | character >> 12);
    else {
      add(0xF0 | character >> 18);
      add(0x80 | (character >> 12 & 0x3F));
    }
    add(0x80 | (character >> 6 & 0x3F));
  }
  add(0x80 | (character & 0x3F));
}

} // namespace

std::unique_ptr<std::istream>
decodedUTF16(std::istream& stream)
{
  char start[64];
  const auto size = stream.read(start, sizeof start).gcount();
  stream.clear();
  stream.seekg(0);
  const Order order = orderOf({start, static_cast<std::size_t>(size)});
  if (order == Order::NONE)
    return nullptr;

  auto& bytes = *stream.rdbuf();
  constexpr auto END = std::istream::traits_type::eof();
  const auto next = [&]() -> std::int64_t { // a unit of 16 bits; -1 at the end
    const int first = bytes.sbumpc();
    const int second = first == END ? END : bytes.sbumpc();
    if (first == END)
      return -1;
    if (second == END)
      throw std::runtime_error("is text in UTF-16 that ends within a character; the "
                               "file is damaged or incomplete");
    return order == Order::LITTLE ? first | second << 8 : first << 8 | second;
  };
  std::string text;
  for (std::int64_t unit = next(); unit >= 0; unit = next()) {
    if (unit >= 0xD800 && unit < 0xDC00) { // the first half of a rare character
      const std::int64_t half = next();
      if (half < 0xDC00 || half > 0xDFFF)
        throw std::runtime_error("is text in UTF-16 with half a character; save it in "
                                 "UTF-8");
      unit = 0x10000 + ((unit - 0xD800) << 10) + (half - 0xDC00);
    }
    if (unit != 0xFEFF) // the mark
      append(text, static_cast<std::uint32_t>(unit));
  }
  return std::make_unique<std::istringstream>(std::move(text));
}

} // namespace tool
