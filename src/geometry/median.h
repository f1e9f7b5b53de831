/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <algorithm>

namespace pcl {
namespace kss {

/** \brief The median of some floats, of an even number of them the upper one.
 * \param[in] values a vector of the standard library or of Eigen; not empty
 */
template <typename Values>
float
median(Values values)
{
  const auto middle = values.data() + values.size() / 2;
  std::nth_element(values.data(), middle, values.data() + values.size());
  return *middle;
}

} // namespace kss
} // namespace pcl
