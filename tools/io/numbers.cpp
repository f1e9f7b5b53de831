/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "numbers.h"

#include <algorithm>
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

/** Whether a text is how programs of an old Microsoft library write what is no number:
 * 1.#QNAN, -1.#IND00, 1.#INF, or rounded to 1.#J. */
bool
isNoNumber(std::string_view text)
{
  const std::string_view name = text.substr(0, text.find_last_not_of('0') + 1);
  for (const char* known : {"#QNAN", "#SNAN", "#IND", "#INF", "#QN", "#QO", "#J", "#R"})
    if (name == known)
      return true;
  return false;
}

/** Read a number as Fortran and other languages write it.
 * \param[in] parsed how much of the text std::from_chars has taken
 */
bool
parseForeign(std::string_view text, std::size_t parsed, double& number)
{
  if (parsed == 0)
    return false;
  const std::string_view mantissa = text.substr(0, parsed);
  std::string_view exponent = text.substr(parsed);
  if (mantissa.back() == '.' && isNoNumber(exponent)) {
    number = std::numeric_limits<double>::quiet_NaN();
    return true;
  }
  const bool has_letter = std::string_view("dDqQ").find(exponent[0]) < 4;
  if (has_letter)
    exponent.remove_prefix(1);
  // without a letter where the exponent has three digits: 0.25-100
  else if (exponent.size() != 4 || mantissa.find('.') == std::string_view::npos ||
           (exponent[0] != '+' && exponent[0] != '-'))
    return false;
  exponent = withoutPlus(exponent);
  char copy[64];
  if (exponent.empty() || mantissa.size() + 1 + exponent.size() > sizeof copy ||
      mantissa.find_first_of("eEnN") != std::string_view::npos)
    return false;
  char* end = std::copy(mantissa.begin(), mantissa.end(), copy);
  *end++ = 'e';
  end = std::copy(exponent.begin(), exponent.end(), end);
  const std::string_view usual(copy, static_cast<std::size_t>(end - copy));
  const auto result = std::from_chars(copy, end, number);
  if (result.ptr == end && result.ec == std::errc::result_out_of_range &&
      isTiny(usual)) {
    number = 0.0;
    return true;
  }
  return result.ptr == end && result.ec == std::errc();
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
    return parseForeign(text, result.ptr - text.data(), number);
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
