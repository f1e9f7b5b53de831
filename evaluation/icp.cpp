/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "icp.h"

#include "../benchmarks/diagonal.h"

#include <pcl/registration/icp.h>
#include <pcl/registration/transformation_estimation_svd_scale.h>

namespace evaluation {

using Point = pcl::PointXYZ;

Answer
refine(const CentredPair& pair,
       const Eigen::Matrix4f& guess,
       const Refinement& refinement)
{
  pcl::IterativeClosestPoint<Point, Point> icp;
  icp.setInputSource(pair.source);
  icp.setInputTarget(pair.target);
  if (refinement.with_scale)
    icp.setTransformationEstimation(
        pcl::make_shared<
            pcl::registration::TransformationEstimationSVDScale<Point, Point>>());
  icp.setMaximumIterations(50);
  icp.setEuclideanFitnessEpsilon(1e-5);
  icp.getConvergeCriteria()->setAbsoluteMSE(0.0); // has a unit

  Eigen::Matrix4f pose = guess;
  for (const double reach : refinement.reaches) {
    icp.setMaxCorrespondenceDistance(reach * benchmarks::diagonalOf(*pair.target));
    Cloud aligned;
    icp.align(aligned, pose);
    pose = icp.getFinalTransformation();
  }

  Answer answer;
  answer.pose = pair.uncentred(pose.cast<double>());
  answer.claimed = icp.hasConverged();
  return answer;
}

} // namespace evaluation
