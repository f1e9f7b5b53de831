/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <cmath>
#include <cstddef>
#include <string>

namespace tool {

/** \brief A number of things: "1 scan", "2 scans". */
inline std::string
counted(std::size_t number, const std::string& thing)
{
  return std::to_string(number) + ' ' + thing + (number == 1 ? "" : "s");
}

/** \brief How long something takes, for people: "12 s", "1 min 5 s", "3 h 20 min". */
inline std::string
timeText(double seconds)
{
  const long all = std::lround(seconds);
  if (all < 60)
    return std::to_string(all) + " s";
  if (all < 3600)
    return std::to_string(all / 60) + " min " + std::to_string(all % 60) + " s";
  return std::to_string(all / 3600) + " h " + std::to_string(all / 60 % 60) + " min";
}

} // namespace tool
