/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "group_picture.h"

namespace tool {

bool
canDrawGroups()
{
  return false;
}

std::vector<SidePicture>
drawGroup(const std::vector<std::pair<std::size_t, Points>>&, int, int)
{
  return {};
}

} // namespace tool
