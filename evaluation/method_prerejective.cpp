/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "described_pair.h"
#include "icp.h"
#include "pcl_methods.h"

#include <pcl/registration/sample_consensus_prerejective.h>

#include <cstdlib>

namespace evaluation {

using Point = pcl::PointXYZ;

// Of all poses that bring so large a share of the source near the target, it takes the
// one with the least error: a quarter, as in PCL's tutorial, leaves room for outliers.
Answer
registerByPrerejective(const Task& task)
{
  std::srand(task.seed);
  const CentredPair pair(task);
  const DescribedPair described(pair);

  pcl::SampleConsensusPrerejective<Point, Point, benchmarks::Feature> prerejective;
  setInput(prerejective, described);
  prerejective.setNumberOfSamples(3);
  prerejective.setCorrespondenceRandomness(5);
  prerejective.setSimilarityThreshold(0.9f);
  prerejective.setMaxCorrespondenceDistance(1.5f * described.leaf);
  prerejective.setInlierFraction(0.25f);
  prerejective.setMaximumIterations(8000);
  return alignAndRefine(prerejective, pair);
}

} // namespace evaluation
