/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "described_pair.h"
#include "icp.h"
#include "pcl_methods.h"

#include <pcl/registration/ia_ransac.h>

#include <cstdlib>

namespace evaluation {

using Point = pcl::PointXYZ;

// SAC-IA compares squared distances with the limit that setMaxCorrespondenceDistance()
// sets: a point that is two leaves off counts as wrong.
Answer
registerBySacIa(const Task& task)
{
  std::srand(task.seed);
  const CentredPair pair(task);
  const DescribedPair described(pair);
  const float leaf = described.leaf;

  pcl::SampleConsensusInitialAlignment<Point, Point, benchmarks::Feature> sac_ia;
  setInput(sac_ia, described);
  sac_ia.setMinSampleDistance(4.0f * leaf);
  sac_ia.setMaxCorrespondenceDistance(4.0f * leaf * leaf);
  sac_ia.setCorrespondenceRandomness(5);
  sac_ia.setMaximumIterations(1000);
  return alignAndRefine(sac_ia, pair);
}

} // namespace evaluation
