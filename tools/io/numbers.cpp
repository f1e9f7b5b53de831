/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "numbers.h"

#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>

namespace tool {
namespace {

/** std::from_chars does not know the plus sign. */
std::string_view
withoutPlus(std::string_view text)
{
  if (text.size() > 1 && text[0] == '+' && text[1] != '-')
    text.remove_prefix(1);
  return text;
}

/** Whether a number out of range is too small: std::from_chars does not tell. */
bool
isTiny(std::string_view number)
{
  const auto exponent = number.find_first_of("eE");
  if (exponent != std::string_view::npos)
    return exponent + 1 < number.size() && number[exponent + 1] == '-';
  return number.find_first_of("123456789.") == number.find('.');
}

template <typename T>
bool
parse(std::string_view text, T& number)
{
  if constexpr (std::is_integral_v<T>) {
    const std::string_view digits = withoutPlus(text);
    const char* end = digits.data() + digits.size();
    const auto result = std::from_chars(digits.data(), end, number);
    if (result.ec == std::errc() && result.ptr == end)
      return true;
    // the same number written as another type
    double real;
    constexpr double limit = 0x1p53; // doubles tell whole numbers apart up to here
    if (!parseNumber(text, real) || !(std::abs(real) <= limit) ||
        real != std::floor(real) || real < std::numeric_limits<T>::lowest() ||
        real > static_cast<double>(std::numeric_limits<T>::max()))
      return false;
    number = static_cast<T>(real);
    return true;
  }
  else {
    double wide;
    if (!parseNumber(text, wide) ||
        (std::isfinite(wide) && std::abs(wide) > std::numeric_limits<T>::max()))
      return false;
    number = static_cast<T>(wide);
    return true;
  }
}

} // namespace

bool
parseNumber(std::string_view text, double& number)
{
  text = withoutPlus(text);
  const char* end = text.data() + text.size();
  const auto result = std::from_chars(text.data(), end, number);
  if (result.ptr != end)
    return false;
  if (result.ec == std::errc::result_out_of_range && isTiny(text)) {
    number = 0.0;
    return true;
  }
  return result.ec == std::errc();
}

bool
parseNumber(std::string_view text, std::int64_t& number)
{
  return parse(text, number);
}

bool
parseNumber(std::string_view text, std::uint8_t datatype, std::uint8_t* bytes)
{
  return withType(datatype, [&](auto number) {
    if (!parse(text, number))
      return false;
    std::memcpy(bytes, &number, sizeof number);
    return true;
  });
}

} // namespace tool
