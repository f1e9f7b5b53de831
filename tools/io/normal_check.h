/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <cmath>
#include <cstddef>

namespace tool {

/** \brief Tells normals from other vectors without knowing their names: nothing else
 * has unit length at every point. Those that could not be found may be zeros, or no
 * numbers.
 */
class NormalCheck {
public:
  void
  add(double x, double y, double z)
  {
    const double length = std::hypot(x, y, z);
    if (std::isnan(length) || length == 0.0)
      ++missing_;
    else if (std::abs(length - 1.0) > 0.01)
      has_others_ = true;
    else
      ++found_;
  }

  bool
  hasOthers() const
  {
    return has_others_;
  }

  bool
  areNormals() const
  {
    return !has_others_ && found_ > 0 && missing_ <= found_;
  }

private:
  std::size_t found_ = 0, missing_ = 0;
  bool has_others_ = false;
};

} // namespace tool
