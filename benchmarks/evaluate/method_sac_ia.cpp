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
  sac_ia.setInputSource(described.source.points);
  sac_ia.setSourceFeatures(described.source.features);
  sac_ia.setInputTarget(described.target.points);
  sac_ia.setTargetFeatures(described.target.features);
  sac_ia.setMinSampleDistance(4.0f * leaf);
  sac_ia.setMaxCorrespondenceDistance(4.0f * leaf * leaf);
  sac_ia.setCorrespondenceRandomness(5);
  sac_ia.setMaximumIterations(1000);
  Cloud aligned;
  sac_ia.align(aligned);

  Answer answer = refine(pair, sac_ia.getFinalTransformation(), {});
  answer.claimed = answer.claimed && sac_ia.hasConverged();
  return answer;
}

} // namespace evaluation
