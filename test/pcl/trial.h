/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "pairs.h"

#include <algorithm>
#include <limits>

namespace kss_test {

using KSSICP = pcl::KSSICP<pcl::PointXYZ, pcl::PointXYZ>;
using Cloud = pcl::PointCloud<pcl::PointXYZ>;

/** \brief KSSICP with what it keeps for subclasses in sight. */
class Open : public KSSICP {
public:
  const pcl::Correspondences&
  correspondences() const
  {
    return *correspondences_;
  }
  int
  iterations() const
  {
    return nr_iterations_;
  }
};

/** \brief The mean squared distance to the nearest target points, by brute force. */
inline double
meanSquaredDistance(const Cloud& aligned, const Cloud& target, double max_range)
{
  const Eigen::Matrix3Xd targets = pointsOf(target).cast<double>();
  double sum = 0.0;
  int pairs = 0;
  for (const pcl::PointXYZ& point : aligned) {
    if (!point.getVector3fMap().allFinite())
      continue;
    double nearest = std::numeric_limits<double>::max();
    for (Eigen::Index i = 0; i < targets.cols(); ++i)
      if (targets.col(i).allFinite())
        nearest = std::min(
            nearest,
            (targets.col(i) - point.getVector3fMap().cast<double>()).squaredNorm());
    if (nearest <= max_range) {
      sum += nearest;
      ++pairs;
    }
  }
  return pairs > 0 ? sum / pairs : std::numeric_limits<double>::max();
}

/** \brief The registration of a pair, with its output. */
struct Trial {
  Open registration;
  Cloud output;

  explicit Trial(const Pair<>& pair)
  {
    makeQuick(registration);
    setClouds(registration, pair);
  }

  Eigen::Matrix4f
  align()
  {
    registration.align(output);
    return registration.getFinalTransformation();
  }

  Eigen::Matrix4f
  align(const Eigen::Matrix4d& guess)
  {
    registration.align(output, guess.cast<float>());
    return registration.getFinalTransformation();
  }
};

} // namespace kss_test
