/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/PCLPointField.h>
#include <pcl/pcl_config.h>

#include <cstdint>
#include <stdexcept>
#include <string_view>

namespace tool {

/** \brief Call a function with a zero of the type that a field's numbers have.
 * \throws std::runtime_error where there is no such type
 */
template <typename Function>
decltype(auto)
withType(std::uint8_t datatype, Function&& function)
{
  switch (datatype) {
  case pcl::PCLPointField::INT8:
    return function(std::int8_t());
  case pcl::PCLPointField::UINT8:
    return function(std::uint8_t());
  case pcl::PCLPointField::INT16:
    return function(std::int16_t());
  case pcl::PCLPointField::UINT16:
    return function(std::uint16_t());
  case pcl::PCLPointField::INT32:
    return function(std::int32_t());
  case pcl::PCLPointField::UINT32:
    return function(std::uint32_t());
  case pcl::PCLPointField::FLOAT32:
    return function(float());
  case pcl::PCLPointField::FLOAT64:
    return function(double());
#if PCL_VERSION_COMPARE(>=, 1, 13, 0)
  case pcl::PCLPointField::INT64:
    return function(std::int64_t());
  case pcl::PCLPointField::UINT64:
    return function(std::uint64_t());
#endif
  }
  throw std::runtime_error("has a field of an unknown type");
}

/** \brief Read one number, with the point as decimal separator whatever the locale.
 *
 * Exponents may have Fortran's D, and what is no number may be written as 1.#QNAN.
 * \return whether the text is a number and nothing else
 */
bool
parseNumber(std::string_view text, double& number);

/** \brief Read one whole number, as above; 3.0 is one, and 3.5 is none. */
bool
parseNumber(std::string_view text, std::int64_t& number);

/** \brief Read one number into the bytes of a type.
 * \param[out] bytes take the number
 * \return whether the text is a number that the type can hold; floating point numbers
 * are rounded
 */
bool
parseNumber(std::string_view text, std::uint8_t datatype, std::uint8_t* bytes);

} // namespace tool
