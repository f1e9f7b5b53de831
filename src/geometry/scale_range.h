/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <algorithm>

namespace pcl {
namespace kss {

/** \brief The scales that a pose between pre-shapes may have. */
struct ScaleRange {
  double smallest = 1.0;
  double largest = 1.0;

  /** \brief The scale of the range that is nearest to another. */
  double
  clamp(double scale) const
  {
    return std::min(std::max(scale, smallest), largest);
  }
};

} // namespace kss
} // namespace pcl
