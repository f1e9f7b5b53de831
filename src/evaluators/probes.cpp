/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "evaluators/probes.h"

#include "evaluators/coordinate_columns.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace pcl {
namespace kss {

Probes
probesOf(const Points& cloud, Eigen::Index number)
{
  constexpr Eigen::Index lanes = 8;
  const Eigen::Index points = cloud.cols();
  number = std::min(number, points);
  const Eigen::MatrixX3f columns = coordinateColumns(cloud.leftCols(number), lanes);
  Probes probes = Probes::Zero(columns.rows(), 6);
  probes.leftCols<3>() = columns;
  if (number == points) {
    probes.col(3).head(number).setConstant(1.0f / points);
    return probes;
  }

  const Eigen::MatrixX3f apart = cloud.transpose();
  const float *x = apart.col(0).data(), *y = apart.col(1).data(),
              *z = apart.col(2).data();
  std::vector<float> squared(points, std::numeric_limits<float>::max());
  std::vector<int> nearest(points, 0);
  for (Eigen::Index n = 0; n < number; ++n) {
    const int probe = static_cast<int>(n);
    const float px = x[n], py = y[n], pz = z[n];
    for (Eigen::Index i = 0; i < points; ++i) {
      const float dx = x[i] - px, dy = y[i] - py, dz = z[i] - pz;
      const float d = dx * dx + dy * dy + dz * dz;
      nearest[i] = d < squared[i] ? probe : nearest[i];
      squared[i] = d < squared[i] ? d : squared[i];
    }
  }
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(number);
  Eigen::VectorXi count = Eigen::VectorXi::Zero(number);
  for (Eigen::Index i = 0; i < points; ++i) {
    const float distance = std::sqrt(squared[i]);
    ++count[nearest[i]];
    sum[nearest[i]] += distance;
    probes(nearest[i], 4) = std::max(probes(nearest[i], 4), distance);
  }
  for (Eigen::Index i = 0; i < number; ++i) {
    probes(i, 3) = static_cast<float>(count[i]) / points;
    if (probes(i, 4) > 0.0f)
      probes(i, 5) = static_cast<float>(sum[i] / count[i] / probes(i, 4));
  }
  return probes;
}

} // namespace kss
} // namespace pcl
