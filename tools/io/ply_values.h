/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "ply_header.h"

#include <istream>
#include <memory>

namespace tool {

/** \brief Goes through the data of a PLY file value by value.
 *
 * All functions throw a std::runtime_error where the file does not hold what is asked
 * for.
 */
class PLYValues {
public:
  virtual ~PLYValues() = default;

  /** \brief Start with the next element. */
  virtual void
  beginElement() = 0;

  /** \brief Take a value into the bytes of its type. */
  virtual void
  take(std::uint8_t datatype, std::uint8_t* bytes) = 0;

  /** \brief Take elements as a whole, if the file has their bytes as memory does.
   * \return whether it has; else nothing is taken
   */
  virtual bool
  takeElements(std::uint8_t*, std::size_t)
  {
    return false;
  }

  /** \brief Expect that the element has no more values. */
  virtual void
  endElement() = 0;

  /** \brief Expect that the file ends. */
  virtual void
  end() = 0;

  /** \brief Throw a std::runtime_error that says where. */
  [[noreturn]] virtual void
  fail(const std::string& problem) const = 0;

  /** \brief Take the length of a list or the number of a point: up to 31 bits. */
  std::uint32_t
  takeCount(std::uint8_t datatype);
};

/** \brief The values behind a header.
 * \param[in] lines,stream of the file, behind the header; must outlive the values
 */
std::unique_ptr<PLYValues>
plyValues(PLYHeader::Encoding encoding, TextLines& lines, std::istream& stream);

} // namespace tool
