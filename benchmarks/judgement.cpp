/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "judgement.h"

#include "diagonal.h"

#include <pcl/common/centroid.h>

#include <cmath>
#include <string>

namespace benchmarks {

Deviation
deviationOf(const Eigen::Matrix4f& pose, const Pair& pair)
{
  const Eigen::Affine3d found(pose.cast<double>());
  const Eigen::Matrix3d turn = found.rotation() * pair.truth.linear().transpose();
  Eigen::Vector4d center = Eigen::Vector4d::Zero();
  pcl::compute3DCentroid(*pair.source, center);
  const double distance =
      (found * center.head<3>() - pair.truth * center.head<3>()).norm();
  return {Eigen::AngleAxisd(turn).angle() * 180.0 / M_PI,
          100.0 * distance / diagonalOf(*pair.target)};
}

bool
isSolved(const Deviation& deviation)
{
  return deviation.degrees < 5.0 && deviation.percent < 5.0;
}

void
judge(benchmark::State& state, const Eigen::Matrix4f& pose, const Pair& pair)
{
  const Deviation deviation = deviationOf(pose, pair);
  state.counters["error_degrees"] = deviation.degrees;
  state.counters["error_percent"] = deviation.percent;
  if (!isSolved(deviation))
    state.SkipWithError(("not solved: " + std::to_string(deviation.degrees) +
                         " degrees, " + std::to_string(deviation.percent) +
                         " % of the diagonal off")
                            .c_str());
}

} // namespace benchmarks
