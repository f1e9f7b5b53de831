/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "virtual_scan.h"

#include <string>

namespace benchmarks {

/** \brief How scans are put into frames that tell nothing. */
enum class Turn {
  NONE, ///< as they are
  YAW,  ///< about the vertical through the scanner, as levelled scanners leave it open
  ANY   ///< about any axis, and moved by about the scan's size
};

/** \brief Put each scan into a frame of its own; its pose follows. */
void
move(VirtualScans& scans, Turn turn, unsigned int seed);

void
shuffle(VirtualScans& scans, unsigned int seed);

/** \brief Write scan_000.pcd and so on, binary, and truth.json with the thing and the
 * pose of each.
 * \throws std::runtime_error naming the file where it cannot be written
 */
void
writeScans(const VirtualScans& scans, const std::string& folder);

/** \brief Read what writeScans() writes, or another file like truth.json.
 * \param[in] truth the JSON file; the scans' files are looked for beside it
 * \throws std::runtime_error naming the file where it cannot be read
 */
VirtualScans
readScans(const std::string& truth);

} // namespace benchmarks
