/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <cmath>
#include <sstream>
#include <string>

namespace tool {

/** \brief Up to three digits of a number: "0.0123". */
inline std::string
shortText(double number)
{
  std::ostringstream text;
  text.precision(3);
  text << number;
  return text.str();
}

/** \brief A share in words: "42 %". */
inline std::string
percent(double share)
{
  return share > 0.0 && share < 0.01
             ? "< 1 %"
             : std::to_string(std::lround(100.0 * share)) + " %";
}

} // namespace tool
