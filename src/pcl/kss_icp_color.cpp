/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "instantiate.h"

PCL_KSS_ICP_INSTANTIATE(pcl::PointXYZRGB)
PCL_KSS_ICP_INSTANTIATE(pcl::PointXYZRGBA)
