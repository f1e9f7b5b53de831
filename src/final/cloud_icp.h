/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/detail/final_stage.h>
#include <pcl/registration/kss/detail/packed_tree.h>
#include <pcl/registration/kss/detail/surface_steps.h>
#include <pcl/registration/kss/detail/tracked_point.h>

#include <Eigen/Core>

#include <memory>
#include <vector>

namespace pcl {
namespace kss {

/** \brief The final ICP for clouds in double precision: nearest points, laid on each
 * other's surfaces. */
class CloudICP : public FinalICP {
public:
  /** \param[in] scorer knows the surfaces of both clouds; kept by reference
   * \param[in] source points that take part, sorted in space
   * \param[in] target in a frame of its own; kept by reference
   * \param[in] tree of its points; kept by reference
   * \param[in] centroid of the source
   * \param[in] rounding_error of the distance of two points
   */
  CloudICP(const PoseScorer& scorer,
           const Eigen::Matrix3Xd& source,
           const LocalCloud& target,
           const PackedTree& tree,
           const Eigen::Vector3d& centroid,
           double rounding_error);

  bool
  iterate(const FinalStep& step,
          const FinalStepSettings& settings,
          StoredPose& pose,
          int& iterations) override;

  std::shared_ptr<FinalRun>
  lastRun(bool is_pose) override;

private:
  /** \brief Pairs of the source, where the pose places it, and the nearest points of
   * the target.
   * \param[in] reach pairs are no longer
   * \return the mean of their squared lengths
   */
  double
  match(const StoredPose& pose, double reach);

  /** \brief The step that the pairs ask for. */
  Eigen::Matrix4d
  nextStep();

  const PoseScorer& scorer_;
  const LocalCloud& target_;
  const PackedTree& tree_;
  Eigen::Vector3d centroid_;
  double rounding_error_;
  Eigen::Matrix3Xd all_, few_;
  const Eigen::Matrix3Xd* source_ = nullptr; ///< those of the two that take part
  std::vector<TrackedPoint> tracked_;        ///< of these
  SurfaceSteps steps_;
  Matches matches_;
  FinalRun last_;
};

} // namespace kss
} // namespace pcl
