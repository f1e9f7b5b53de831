/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "icp.h"
#include "pcl_methods.h"

namespace evaluation {
namespace {

/** \brief All points count: nothing is known about the pose. */
const std::vector<double> everything{10.0};

} // namespace

Answer
registerByIcp(const Task& task)
{
  return refine(CentredPair(task), Eigen::Matrix4f::Identity(), {false, everything});
}

Answer
registerByScalingIcp(const Task& task)
{
  const CentredPair pair(task);
  Eigen::Matrix4f guess = Eigen::Matrix4f::Identity();
  if (!task.same_scale)
    guess.topLeftCorner<3, 3>() *=
        rmsRadiusOf(*pair.target) / rmsRadiusOf(*pair.source);
  return refine(pair, guess, {!task.same_scale, everything});
}

} // namespace evaluation
