/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

// One cloud placed upon another, and what to ask of the result: docs/tutorial.md
// explains it line by line.
//
//   00_first_registration [SOURCE.pcd TARGET.pcd [ALIGNED.pcd]]

#include "lump.h"

#include <pcl/common/transforms.h>
#include <pcl/registration/kss_icp.h>

#include <iostream>

using Cloud = pcl::PointCloud<pcl::PointXYZ>;

/** The lump without what lies in one direction, as if a scanner had not seen it. */
Cloud::Ptr
withoutOneSide(const Cloud& lump, const Eigen::Vector3f& side)
{
  Cloud::Ptr rest(new Cloud);
  for (const pcl::PointXYZ& point : lump)
    if (point.getVector3fMap().dot(side) < 0.5f)
      rest->push_back(point);
  return rest;
}

int
main(int argc, char** argv)
{
  Cloud::Ptr source, target;
  if (argc >= 3) {
    source = example::load<pcl::PointXYZ>(argv[1]);
    target = example::load<pcl::PointXYZ>(argv[2]);
  }
  else {
    source = withoutOneSide(*example::makeLump<pcl::PointXYZ>(8000, 1), {1, 0, 0});
    target = withoutOneSide(*example::makeLump<pcl::PointXYZ>(12000, 2), {0, 0, 1});
    const Eigen::Affine3f turned =
        example::makePose(140.0f, {1.0f, 2.0f, 3.0f}, {5.0f, -3.0f, 2.0f});
    pcl::transformPointCloud(*target, *target, turned);
  }

  pcl::KSSICP<pcl::PointXYZ, pcl::PointXYZ> registration;
  registration.setInputSource(source);
  registration.setInputTarget(target);
  registration.setScaleEstimation(false); // both are in the same unit

  Cloud aligned;
  registration.align(aligned);

  if (!registration.hasConverged()) {
    std::cerr << "not registered: " << registration.getFailureReason() << '\n';
    return 1;
  }

  std::cout << "source to target:\n" << registration.getFinalTransformation() << '\n';
  std::cout << "confidence: " << registration.getConfidence() << '\n';
  std::cout << "another pose is about as good: " << std::boolalpha
            << registration.isAmbiguous() << '\n';
  const pcl::kss::Overlap overlap = registration.getOverlap();
  std::cout << "overlap: " << 100.0 * overlap.source << " % of the source, "
            << 100.0 * overlap.target << " % of the target\n";

  if (argc >= 4)
    pcl::io::savePCDFileBinary(argv[3], aligned);
  return 0;
}
