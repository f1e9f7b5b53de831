/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/PCLPointCloud2.h>
#include <pcl/registration/kss/detail/bulk.h>
#include <pcl/registration/kss/failure.h>
#include <pcl/registration/kss/result.h>
#include <pcl/registration/kss/settings.h>
#include <pcl/registration/kss/stages.h>

#include <optional>
#include <string>
#include <vector>

namespace tool {

/** \brief A pose, and how much of the clouds lies on each other there. */
struct Pose {
  Eigen::Matrix4d transformation;
  pcl::kss::Overlap overlap;
  pcl::kss::Evidence evidence;
};

/** \brief What a registration found, in the coordinates of the files. */
struct Result {
  bool converged;
  pcl::kss::FailureCause cause;
  /** \brief Why it has not converged. */
  std::string reason;
  /** \brief All distinct poses, the likeliest first: the result; none where
   * there is none. */
  std::vector<Pose> poses;
  double scale;
  /** \brief Of the first pose, see KSSICP::getCovariance(); empty where not known. */
  Eigen::MatrixXd covariance;
  double scale_deviation;
  /** \brief In how many directions the surfaces leave the first pose undetermined. */
  int undetermined;
  /** \brief How sure it is that the pose is right, in [0, 1]. */
  double confidence;
  /** \brief Whether the second pose is about as good as the first. */
  bool ambiguous;
  /** \brief Which parts of the object the clouds show. */
  pcl::kss::Mode mode;
  /** \brief How the candidates were searched. */
  pcl::kss::Search search;
  /** \brief The mean squared distance of the source's points from the nearest ones of
   * the target, see fitnessOf(); none where it was not asked for, or there is no pose.
   */
  std::optional<double> fitness;
  /** \brief How many points of each cloud were left out, too far away from the others.
   */
  pcl::kss::FarPoints far_points;
  std::string device;
  std::vector<pcl::kss::StageSeconds> stages;
  double seconds;
};

/** \brief Register two clouds, by their normals, too, where either has some.
 * \param[in] source has x, y and z, and at least one finite point
 * \param[in] target the same
 * \param[in] guess in the coordinates of the files; none: no guess
 * \param[in] iterations of the final ICP at most; 0: as many as the library allows
 * \param[in] with_fitness whether to find the fitness, too
 */
Result
registerClouds(const pcl::PCLPointCloud2& source,
               const pcl::PCLPointCloud2& target,
               const pcl::kss::Settings& settings,
               const std::optional<Eigen::Matrix4d>& guess,
               int iterations,
               bool with_fitness);

} // namespace tool
