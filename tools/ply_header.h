/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <cstdint>
#include <istream>
#include <string>
#include <vector>

namespace tool {

/** \brief The header of a PLY file. */
struct PLYHeader {
  struct Property {
    std::string name;
    std::string type;
    /** \brief The type of a list's length; empty where the property is no list. */
    std::string length_type;
  };

  struct Element {
    std::string name;
    std::uint64_t count;
    std::vector<Property> properties;

    /** \brief The property of that name, or null. */
    const Property*
    find(const std::string& property) const;

    /** \brief The bytes that the element takes in a binary file with empty lists. */
    std::uint64_t
    leastBytes() const;
  };

  /** \brief Read a header up to and with its end_header.
   * \throws std::runtime_error where it is wrong or cut short
   */
  explicit PLYHeader(std::istream& stream);

  /** \brief The element of that name, or null. */
  const Element*
  find(const std::string& element) const;

  bool ascii = false;
  std::vector<Element> elements;
  /** \brief Columns and rows of an organised cloud; 0 where the header has none. */
  std::uint64_t columns = 0, rows = 0;
  /** \brief How many lines the header has. */
  std::size_t lines = 0;
};

} // namespace tool
