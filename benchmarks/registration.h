/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "clouds.h"

#include <pcl/registration/kss_icp.h>

namespace benchmarks {

using KSSICP = pcl::KSSICP<pcl::PointXYZ, pcl::PointXYZ>;

/** \brief Register once, so that the kernels are compiled and the device is in use
 * before anything is measured; later calls do nothing.
 */
void
warmUp();

} // namespace benchmarks
