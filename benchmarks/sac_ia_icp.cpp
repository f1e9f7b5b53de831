/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "sac_ia_icp.h"

#include "diagonal.h"
#include "fpfh.h"
#include "process.h"

#include <pcl/registration/ia_ransac.h>
#include <pcl/registration/icp.h>

#include <cstdlib>

namespace benchmarks {
namespace {

using Point = pcl::PointXYZ;

/** \brief CPU seconds from one step to the next. */
class Laps {
public:
  double
  lap()
  {
    const double now = cpuSeconds(), seconds = now - last_;
    last_ = now;
    return seconds;
  }

private:
  double last_ = cpuSeconds();
};

/** \brief PCL keeps the number of iterations to itself. */
class CountedIcp : public pcl::IterativeClosestPoint<Point, Point> {
public:
  int
  iterations() const
  {
    return nr_iterations_;
  }
};

/** \brief The three samples keep a tenth of the diagonal apart, and a point that is two
 * leaves off counts as wrong. SAC-IA compares \e squared distances with the limit that
 * setMaxCorrespondenceDistance() sets.
 */
Eigen::Matrix4f
alignInitially(const Described& source,
               const Described& target,
               float leaf,
               const Effort& effort)
{
  pcl::SampleConsensusInitialAlignment<Point, Point, Feature> sac_ia;
  sac_ia.setInputSource(source.points);
  sac_ia.setSourceFeatures(source.features);
  sac_ia.setInputTarget(target.points);
  sac_ia.setTargetFeatures(target.features);
  sac_ia.setMinSampleDistance(5.0f * leaf);
  sac_ia.setMaxCorrespondenceDistance(4.0f * leaf * leaf);
  sac_ia.setCorrespondenceRandomness(effort.randomness);
  sac_ia.setMaximumIterations(effort.samplings);
  Cloud aligned;
  sac_ia.align(aligned);
  return sac_ia.getFinalTransformation();
}

void
finish(const Pair& pair, const Effort& effort, SacIaResult& result)
{
  CountedIcp icp;
  icp.setInputSource(pair.source);
  icp.setInputTarget(pair.target);
  icp.setMaximumIterations(effort.icp_iterations);
  if (effort.icp_mse_change > 0.0)
    icp.setEuclideanFitnessEpsilon(effort.icp_mse_change);
  Cloud aligned;
  icp.align(aligned, result.pose);
  result.pose = icp.getFinalTransformation();
  result.icp_iterations = icp.iterations();
}

} // namespace

SacIaResult
registerBySacIa(const Pair& pair, const Effort& effort, unsigned int seed)
{
  std::srand(seed);
  SacIaResult result;
  Laps laps;

  Described source, target;
  const float leaf = static_cast<float>(diagonalOf(*pair.target) / 50.0);
  thin(pair.source, leaf, source);
  thin(pair.target, leaf, target);
  result.voxel_grid = laps.lap();

  estimateNormals(2.0f * leaf, source);
  estimateNormals(2.0f * leaf, target);
  result.normals = laps.lap();

  describe(5.0f * leaf, source);
  describe(5.0f * leaf, target);
  result.features = laps.lap();

  result.pose = alignInitially(source, target, leaf, effort);
  result.sac_ia = laps.lap();

  finish(pair, effort, result);
  result.icp = laps.lap();
  return result;
}

} // namespace benchmarks
