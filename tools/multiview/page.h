/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "group_picture.h"
#include "model.h"

#include <string>
#include <vector>

namespace tool {

/** \brief The pictures of a group, and how many points its merged cloud has. */
struct GroupShow {
  std::vector<SidePicture> pictures;
  std::size_t points = 0;
};

/** \brief A page for people, as HTML that needs no other file and no network.
 *
 * It stays small: of thousands of scans it shows some, and says so.
 * \param[in] names of the scans, see scanNames()
 * \param[in] groups as many as connectedGroups() has
 */
std::string
pageText(const Model& model,
         const std::vector<std::string>& names,
         const std::vector<GroupShow>& groups);

} // namespace tool
