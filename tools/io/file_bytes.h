/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <cstdint>
#include <istream>

namespace tool {

/** \brief How many bytes follow in a file: what a header announces can be no more. */
inline std::uint64_t
remainingBytes(std::istream& stream)
{
  const auto here = stream.tellg();
  stream.seekg(0, std::ios::end);
  const auto end = stream.tellg();
  stream.seekg(here);
  return stream ? static_cast<std::uint64_t>(end - here) : 0;
}

} // namespace tool
