/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <sstream>
#include <string>

namespace tool {

/** \brief Text in lines, for people.
 * \param[in] width of the lines at most, unless a word is wider
 * \param[in] indent of all lines but the first, which is taken to begin there
 */
inline std::string
wrapped(const std::string& text, std::size_t width, std::size_t indent)
{
  std::istringstream words(text);
  std::string lines;
  std::size_t column = indent;
  for (std::string word; words >> word;) {
    if (column == indent)
      column += word.size();
    else if (column + 1 + word.size() > width) {
      lines += '\n' + std::string(indent, ' ');
      column = indent + word.size();
    }
    else {
      lines += ' ';
      column += 1 + word.size();
    }
    lines += word;
  }
  return lines;
}

} // namespace tool
