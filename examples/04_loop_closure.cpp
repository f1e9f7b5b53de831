/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

// A loop of clouds whose poses drifted: KSSICP registers the last cloud to the first
// one, and pcl::registration::ELCH spreads the correction over the loop.
//
//   04_loop_closure [FIRST.pcd SECOND.pcd THIRD.pcd ...]

#include "lump.h"

#include <pcl/common/transforms.h>
#include <pcl/registration/elch.h>
#include <pcl/registration/kss_icp.h>

#include <iostream>
#include <vector>

using Cloud = pcl::PointCloud<pcl::PointXYZ>;

int
main(int argc, char** argv)
{
  std::vector<Cloud::Ptr> clouds;
  std::vector<Eigen::Affine3f> truth; // what mends each cloud's drift
  for (int i = 1; i < argc; ++i)
    clouds.push_back(example::load<pcl::PointXYZ>(argv[i]));
  const bool generated = clouds.empty();
  for (int i = 0; generated && i < 6; ++i) {
    truth.push_back(
        example::makePose(10.0f * i, {0.0f, 0.0f, 1.0f}, {0.2f * i, 0.1f * i, 0.0f}));
    clouds.push_back(example::makeLump<pcl::PointXYZ>(6000, i));
    pcl::transformPointCloud(*clouds.back(), *clouds.back(), truth.back().inverse());
  }
  if (clouds.size() < 3) {
    std::cerr << "a loop needs three clouds\n";
    return 2;
  }

  pcl::registration::ELCH<pcl::PointXYZ> elch;
  for (const Cloud::Ptr& cloud : clouds)
    elch.addPointCloud(cloud);
  elch.setLoopStart(0);
  elch.setLoopEnd(clouds.size() - 1);

  // ELCH takes the rotation and the translation of what it gets and drops a scale,
  // which would leave a wrong translation: switch its estimation off. ELCH would call
  // align() by itself, but never look at hasConverged(): so register here, and hand it
  // the result.
  pcl::KSSICP<pcl::PointXYZ, pcl::PointXYZ> kss_icp;
  kss_icp.setScaleEstimation(false);
  kss_icp.setInputSource(clouds.back());
  kss_icp.setInputTarget(clouds.front());
  Cloud aligned;
  kss_icp.align(aligned);
  if (!kss_icp.hasConverged()) {
    std::cerr << kss_icp.getFailureReason() << '\n';
    return 1;
  }
  elch.setLoopTransform(kss_icp.getFinalTransformation());
  elch.compute();

  for (std::size_t i = 0; i < clouds.size(); ++i) {
    const Eigen::Affine3f correction = (*elch.getLoopGraph())[i].transform;
    std::cout << "correction of cloud " << i << ":\n" << correction.matrix() << '\n';
    if (generated) {
      const double error = example::misplacement(correction, truth[i]);
      std::cout << "misplaced by " << error << " % of the radius\n";
      if (!(error < example::tolerance))
        return 1;
    }
  }
  return 0;
}
