/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "model.h"
#include "scan_points.h"

#include <functional>
#include <ostream>
#include <vector>

namespace tool {

/** \brief Write the points of all scans of a group in one PLY file, scan by scan, so
 * that one at a time is in memory; where they are thinned, a number for each point that
 * is written, too.
 *
 * Points have x, y and z, of double where floats would be too coarse, what all scans
 * have of normals, colours and intensity, and the number of their scan, from 1. What is
 * not finite is left out.
 * \param[in] group the numbers of the scans
 * \param[in] looks at all scans of the model
 * \param[in] done told of each scan; may be empty
 * \param[in] stream has to be able to go back to its beginning
 * \throws std::runtime_error where a scan cannot be read again
 * \return the number of points
 */
std::size_t
writeMergedCloud(const Model& model,
                 const std::vector<std::size_t>& group,
                 const std::vector<ScanLook>& looks,
                 const std::function<void()>& done,
                 std::ostream& stream);

} // namespace tool
