/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

// From IterativeClosestPoint to KSSICP by the change of one type name.
//
//   01_icp_swap [SOURCE.pcd TARGET.pcd]

#include "lump.h"

#include <pcl/common/transforms.h>
#include <pcl/registration/icp.h>
#include <pcl/registration/kss_icp.h>

#include <iostream>

using Cloud = pcl::PointCloud<pcl::PointXYZ>;

/** An ordinary ICP program: nothing in it depends on which of the two it gets. */
template <typename Registration>
Eigen::Affine3f
registerClouds(const char* name,
               Registration& icp,
               Cloud::Ptr source,
               Cloud::Ptr target)
{
  icp.setInputSource(source);
  icp.setInputTarget(target);
  icp.setMaximumIterations(100);

  Cloud aligned;
  icp.align(aligned);

  std::cout << name << ": hasConverged " << std::boolalpha << icp.hasConverged()
            << ", mean squared distance " << icp.getFitnessScore() << '\n'
            << icp.getFinalTransformation() << '\n';
  return Eigen::Affine3f(icp.getFinalTransformation());
}

int
main(int argc, char** argv)
{
  Cloud::Ptr source, target;
  const Eigen::Affine3f truth =
      example::makePose(140.0f, {1.0f, 2.0f, 3.0f}, {5.0f, -3.0f, 2.0f}, 2.5f);
  const bool generated = argc != 3;
  if (generated) {
    source = example::makeLump<pcl::PointXYZ>(8000, 1);
    target = example::makeLump<pcl::PointXYZ>(12000, 2);
    pcl::transformPointCloud(*target, *target, truth);
  }
  else {
    source = example::load<pcl::PointXYZ>(argv[1]);
    target = example::load<pcl::PointXYZ>(argv[2]);
  }

  pcl::IterativeClosestPoint<pcl::PointXYZ, pcl::PointXYZ> icp; // before
  pcl::KSSICP<pcl::PointXYZ, pcl::PointXYZ> kss_icp;            // after

  const Eigen::Affine3f by_icp =
      registerClouds("IterativeClosestPoint", icp, source, target);
  const Eigen::Affine3f by_kss_icp = registerClouds("KSSICP", kss_icp, source, target);
  if (!generated)
    return kss_icp.hasConverged() ? 0 : 1;

  // The lump was turned by 140 degrees, moved, and made 2.5 times as large.
  const double error = example::misplacement(by_kss_icp, truth);
  std::cout << "misplaced by IterativeClosestPoint: "
            << example::misplacement(by_icp, truth)
            << " % of the radius\nmisplaced by KSSICP: " << error
            << " % of the radius\n";
  return kss_icp.hasConverged() && error < example::tolerance ? 0 : 1;
}
