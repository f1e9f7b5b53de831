/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "instantiate.h"

PCL_KSS_ICP_INSTANTIATE(pcl::PointNormal)
PCL_KSS_ICP_INSTANTIATE(pcl::PointXYZINormal)
PCL_KSS_ICP_INSTANTIATE(pcl::PointXYZRGBNormal)
