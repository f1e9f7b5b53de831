/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <string_view>

namespace tool {

/** \brief Whether a character is a space, a tab, or the end of a line or page. */
inline bool
isWhite(char character)
{
  return character == ' ' || (character >= '\t' && character <= '\r');
}

/** \brief A text without the white space around it. */
inline std::string_view
trimmed(std::string_view text)
{
  while (!text.empty() && isWhite(text.front()))
    text.remove_prefix(1);
  while (!text.empty() && isWhite(text.back()))
    text.remove_suffix(1);
  return text;
}

} // namespace tool
