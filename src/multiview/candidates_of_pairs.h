/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/multiview.h>

#include <cstddef>
#include <vector>

namespace pcl {
namespace kss {

/** \brief A pose of one scan on another that may be right. */
struct PoseCandidate {
  std::size_t pair = 0; ///< which pair says so
  std::size_t pose = 0; ///< which of its poses
  std::size_t source = 0, target = 0;
  StoredPose transformation = StoredPose::Identity();
  /** \brief How probable it is as far as the pair alone tells, between 0 and 1. */
  double probability = 0.0;
};

/** \brief No pair is surer than that, whatever it says: it may show something that
 * looks the same elsewhere. Fitted by evaluation/fit_many_scans.py. */
constexpr double surest = 0.8;

/** \brief The poses of pairs that may be right, as far as each pair alone tells.
 * \param[in] shifts of the logarithm of the odds of each pair: less than 0 where it is
 * less sure than it says; empty: none
 */
std::vector<PoseCandidate>
candidatesOf(const std::vector<PairResult>& pairs,
             const std::vector<double>& shifts = {});

/** \brief The logarithm of the odds. */
double
logOdds(double probability);

} // namespace kss
} // namespace pcl
