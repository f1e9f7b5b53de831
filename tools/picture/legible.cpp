/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "legible.h"

#include <cstdint>

namespace tool {

std::string
legible(const std::string& text)
{
  std::string legible;
  for (std::size_t i = 0; i < text.size();) {
    const auto at = [&](std::size_t place) {
      return place < text.size() ? static_cast<unsigned char>(text[place]) : 0u;
    };
    const unsigned int lead = at(i);
    const std::size_t length = lead < 0x80                   ? 1
                               : lead >= 0xc2 && lead < 0xe0 ? 2
                               : lead >= 0xe0 && lead < 0xf0 ? 3
                               : lead >= 0xf0 && lead < 0xf5 ? 4
                                                             : 0;
    std::uint32_t code = length < 2 ? lead : lead & (0x7fu >> length);
    bool is_valid = length > 0 && lead >= 0x20 && lead != 0x7f;
    for (std::size_t byte = 1; byte < length; ++byte) {
      is_valid = is_valid && (at(i + byte) & 0xc0) == 0x80;
      code = code << 6 | (at(i + byte) & 0x3f);
    }
    // longer than need be, halves of pairs, or beyond the last character
    is_valid = is_valid && !(length == 3 && code < 0x800) &&
               !(length == 4 && (code < 0x10000 || code > 0x10ffff)) &&
               !(code >= 0xd800 && code < 0xe000);
    legible += is_valid ? text.substr(i, length) : "?";
    i += is_valid ? length : 1;
  }
  return legible;
}

} // namespace tool
