/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "text_lines.h"

#include <cstdint>
#include <string>
#include <vector>

namespace tool {

/** \brief The header of a PLY file, in which every line is understood. */
struct PLYHeader {
  enum class Encoding { ASCII, LITTLE, BIG };

  struct Property {
    std::string name;
    /** \brief The type as PCL numbers them. */
    std::uint8_t datatype = 0;
    /** \brief Whether the property is a list, and the type of its length. */
    bool is_list = false;
    std::uint8_t length_datatype = 0;
  };

  struct Element {
    std::string name;
    std::uint64_t count;
    std::vector<Property> properties;

    /** \brief The property of that name, or null. */
    const Property*
    find(const std::string& property) const;

    /** \brief The least bytes that an element takes in the file: its lists may be
     * empty. */
    std::uint64_t
    leastBytes(Encoding encoding) const;
  };

  /** \brief Read a header up to and with its end_header.
   * \throws std::runtime_error where it is wrong or cut short
   */
  explicit PLYHeader(TextLines& lines);

  /** \brief The element of that name, or null. */
  const Element*
  find(const std::string& element) const;

  Encoding encoding = Encoding::ASCII;
  std::vector<Element> elements;
  /** \brief Columns and rows of an organised cloud; 0 where the header has none. */
  std::uint64_t columns = 0, rows = 0;
  /** \brief What somebody has written into it; what starts with obj_info is for
   * programs.
   */
  std::vector<std::string> comments;
};

} // namespace tool
