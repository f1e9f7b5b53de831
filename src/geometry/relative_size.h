/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <algorithm>

namespace pcl {
namespace kss {

/** \brief Whether one of two clouds is so much smaller than the other that it may be an
 * object in a scene: half of an object is about 0.6 times as large as the whole.
 * \param[in] ratio of their root mean square radii, either way
 */
inline bool
mayBeInScene(double ratio)
{
  constexpr double small_object = 0.6;
  return std::min(ratio, 1.0 / ratio) < small_object;
}

} // namespace kss
} // namespace pcl
