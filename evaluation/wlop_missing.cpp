/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "resampling.h"

#include <stdexcept>

namespace evaluation {

bool
hasWLOP()
{
  return false;
}

SurfacePoints
simplifiedByWLOP(const SurfacePoints&, std::size_t)
{
  throw std::runtime_error("built without CGAL: configure with "
                           "-DPCL_KSS_ICP_BENCHMARKS_WITH_CGAL=ON");
}

} // namespace evaluation
