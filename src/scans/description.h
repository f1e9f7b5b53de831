/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/scan_work.h>

namespace pcl {
namespace kss {

/** \brief What a scan that has been made ready is like. */
ScanDescription
descriptionOf(const PreparedScan& scan);

} // namespace kss
} // namespace pcl
