/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "html.h"

#include "picture/legible.h"

#include <cstdint>
#include <iomanip>
#include <sstream>

namespace tool {

std::string
escaped(const std::string& text)
{
  std::string escaped;
  for (const char letter : legible(text))
    switch (letter) {
    case '&':
      escaped += "&amp;";
      break;
    case '<':
      escaped += "&lt;";
      break;
    case '>':
      escaped += "&gt;";
      break;
    case '"':
      escaped += "&quot;";
      break;
    case '\'':
      escaped += "&#39;";
      break;
    default:
      escaped += letter;
    }
  return escaped;
}

std::string
fixedText(double number, int digits)
{
  std::ostringstream text;
  text << std::fixed << std::setprecision(digits) << number;
  return text.str();
}

std::string
groupedText(std::size_t number)
{
  std::string text = std::to_string(number);
  for (int place = static_cast<int>(text.size()) - 3; place > 0; place -= 3)
    text.insert(static_cast<std::size_t>(place), ",");
  return text;
}

std::string
cssColour(const Colour& colour)
{
  std::ostringstream text;
  text << '#' << std::hex << std::setw(6) << std::setfill('0')
       << (packed(colour) & 0xffffff);
  return text.str();
}

std::string
base64(const std::string& bytes)
{
  static const char* const digits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t three = 0;
    for (std::size_t j = i; j < i + 3; ++j)
      three =
          three << 8 | (j < bytes.size() ? static_cast<unsigned char>(bytes[j]) : 0u);
    for (std::size_t j = 0; j < 4; ++j)
      text += i + j > bytes.size() ? '=' : digits[three >> (18 - 6 * j) & 63];
  }
  return text;
}

} // namespace tool
