/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

namespace pcl {
namespace kss {

/** \brief The smallest multiple that is not smaller than a value.
 * \param[in] value not negative
 * \param[in] multiple of what
 */
template <typename Integer>
constexpr Integer
roundedUp(Integer value, Integer multiple)
{
  return (value + multiple - 1) / multiple * multiple;
}

} // namespace kss
} // namespace pcl
