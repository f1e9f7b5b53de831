/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "method.h"

namespace evaluation {

std::vector<Method>
open3dMethods()
{
  return {};
}

} // namespace evaluation
