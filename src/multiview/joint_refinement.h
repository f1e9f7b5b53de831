/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "multiview/placed_scans.h"

#include <functional>
#include <vector>

namespace pcl {
namespace kss {

/** \brief Move all scans of a group at once to where the points of all of them that
 * match lie on each other's planes: each pair of scans that overlap makes a step of
 * ICP, and the poses are those that are in best agreement with all steps.
 * \param[in,out] placed
 * \param[in] work does tasks; they are the work from one share of all to another
 */
void
refineJointly(PlacedScans& placed,
              const std::function<std::vector<ScanAnswer>(
                  const std::vector<ScanTask>&, double from, double to)>& work);

} // namespace kss
} // namespace pcl
