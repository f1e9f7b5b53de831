/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <sstream>
#include <string>

namespace pcl {
namespace kss {

/** \brief A number as a sentence quotes it. */
inline std::string
shortText(double number)
{
  std::ostringstream text;
  text.precision(4);
  text << number;
  return text.str();
}

} // namespace kss
} // namespace pcl
