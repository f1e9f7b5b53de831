/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "model.h"

#include <functional>
#include <string>
#include <vector>

namespace tool {

/** \brief Check that files could be written to a folder, and make it.
 * \throws std::runtime_error naming it where they could not, or a scan in it that they
 * would replace
 */
void
prepareFolder(const std::string& folder, const std::vector<std::string>& scans);

/** \brief Write all that is known of many scans to a folder: poses.json, poses/,
 * graph.json, pairs.csv, graph_1.g2o..., merged_1.ply..., index.html.
 *
 * Each is there as a whole or not at all; index.html is the last. What an earlier run
 * has left there, and this one does not write again, is removed: what its poses.json
 * names.
 * \param[in] folder as prepareFolder() makes it
 * \param[in] progress told which share of the work is done; may be empty
 * \throws std::runtime_error naming the file where one cannot be read or written
 */
void
writeFolder(const Model& model,
            const std::string& folder,
            const std::function<void(double)>& progress = {});

} // namespace tool
