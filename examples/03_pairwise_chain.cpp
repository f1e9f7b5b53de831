/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

// A chain of clouds, each registered to the one before it, whatever the motion between
// them: KSSICP inside pcl::registration::IncrementalRegistration.
//
//   03_pairwise_chain [FIRST.pcd SECOND.pcd ...]

#include "lump.h"

#include <pcl/common/transforms.h>
#include <pcl/registration/incremental_registration.h>
#include <pcl/registration/kss_icp.h>

#include <algorithm>
#include <iostream>
#include <vector>

using Cloud = pcl::PointCloud<pcl::PointXYZ>;

int
main(int argc, char** argv)
{
  std::vector<Cloud::Ptr> clouds;
  std::vector<Eigen::Affine3f> truth; // from each cloud to the first
  for (int i = 1; i < argc; ++i)
    clouds.push_back(example::load<pcl::PointXYZ>(argv[i]));
  const bool generated = clouds.empty();
  for (int i = 0; generated && i < 4; ++i) {
    truth.push_back(example::makePose(100.0f * i, {1.0f, 1.0f * i, -2.0f},
                                      {3.0f * i, 0.0f, 1.0f * i}));
    clouds.push_back(example::makeLump<pcl::PointXYZ>(6000 + 1000 * i, i));
    pcl::transformPointCloud(*clouds.back(), *clouds.back(), truth.back().inverse());
  }

  // IncrementalRegistration multiplies the transformations of the pairs. If each had a
  // scale of its own, the small errors of these scales would multiply, too, and the
  // chain would shrink or grow along its way: for clouds in the same unit, switch it
  // off.
  pcl::KSSICP<pcl::PointXYZ, pcl::PointXYZ>::Ptr kss_icp(
      new pcl::KSSICP<pcl::PointXYZ, pcl::PointXYZ>);
  kss_icp->setScaleEstimation(false);

  pcl::registration::IncrementalRegistration<pcl::PointXYZ> chain;
  chain.setRegistration(kss_icp);

  for (std::size_t i = 0; i < clouds.size(); ++i) {
    // A cloud that did not converge is left out: the next one is registered to the last
    // one that did.
    if (!chain.registerCloud(clouds[i])) {
      std::cerr << "cloud " << i << ": " << kss_icp->getFailureReason() << '\n';
      return 1;
    }
    const Eigen::Affine3f to_first(chain.getAbsoluteTransform());
    std::cout << "cloud " << i << " to cloud 0:\n" << to_first.matrix() << '\n';
    if (generated) {
      const double error = example::misplacement(to_first, truth[i]);
      std::cout << "misplaced by " << error << " % of the radius\n";
      // the errors of the links add up
      if (!(error < example::tolerance * std::max<std::size_t>(1, i)))
        return 1;
    }
  }
  return 0;
}
