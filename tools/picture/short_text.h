/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

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

} // namespace tool
