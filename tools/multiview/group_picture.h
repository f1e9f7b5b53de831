/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "io/geometry.h"

#include <string>
#include <utility>
#include <vector>

namespace tool {

/** \brief A picture of a group of scans from one side. */
struct SidePicture {
  /** \brief From where it is seen, in words. */
  std::string side;
  std::string png;
  /** \brief A round length, and the share of the picture's width that it takes. */
  double ruler = 0.0, ruler_share = 0.0;
};

/** \brief Whether pictures can be drawn: the program was built with what draws them. */
bool
canDrawGroups();

/** \brief Draw a group of scans, each in the colour of its number, from its broad side,
 * from its long side, and from its end.
 * \param[in] scans the number of each, and points of it in the frame of the group
 * \return none where nothing can be drawn
 */
std::vector<SidePicture>
drawGroup(const std::vector<std::pair<std::size_t, Points>>& scans,
          int width,
          int height);

} // namespace tool
