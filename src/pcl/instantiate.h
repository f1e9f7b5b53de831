/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss_icp.h>

/** \brief Compiles KSSICP for a point type, as kss_icp.h declares it. */
#define PCL_KSS_ICP_INSTANTIATE(PointT)                                                \
  template class pcl::KSSICP<PointT, PointT, float>;                                   \
  template class pcl::KSSICP<PointT, PointT, double>;
