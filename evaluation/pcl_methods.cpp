/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "pcl_methods.h"

namespace evaluation {

std::vector<Method>
pclMethods()
{
  return {{"ICP", false, registerByIcp, {}},
          {"ICP with scale", true, registerByScalingIcp, {}},
          {"SAC-IA", false, registerBySacIa, {}},
          {"Prerejective", false, registerByPrerejective, {}},
          {"FPCS", false, registerByFpcs, {}},
          {"KFPCS", false, registerByKfpcs, {}}};
}

} // namespace evaluation
