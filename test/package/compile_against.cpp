/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#define PCL_NO_PRECOMPILE // all that the class needs is compiled here
#include <pcl/registration/kss_icp.h>

template class pcl::KSSICP<pcl::PointXYZ, pcl::PointXYZ>;
template class pcl::KSSICP<pcl::PointNormal, pcl::PointNormal, double>;

/** The calls that some version of PCL resolves otherwise than others. */
double
scores(pcl::KSSICP<pcl::PointXYZ, pcl::PointXYZ>& registration,
       const std::vector<float>& distances)
{
  return registration.getFitnessScore() + registration.getFitnessScore(0.5) +
         registration.getFitnessScore(0.5, true) +
         registration.getFitnessScore(distances, distances);
}
