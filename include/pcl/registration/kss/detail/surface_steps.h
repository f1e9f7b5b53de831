/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/alignment.h>
#include <pcl/registration/kss/detail/surface_step.h>
#include <pcl/registration/kss/export.h>

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace pcl {
namespace kss {

/** \brief Matched points of two clouds, and which ones they are: a column, or an entry,
 * per pair. */
struct Matches {
  Eigen::Matrix3Xd source;           ///< points, where the pose so far has placed them
  Eigen::Matrix3Xd target;           ///< the points that they are matched with
  std::vector<std::int32_t> queries; ///< the indices of the source's
  std::vector<std::int32_t> matches; ///< the indices of the target's
};

/** \brief The steps of a run of ICP in which points are laid on each other's tangent
 * planes (surfaceStep()), which come from the surfaces that the alignment has made of
 * both clouds.
 */
class PCL_KSS_ICP_EXPORT SurfaceSteps {
public:
  SurfaceSteps();

  ~SurfaceSteps();

  /** \brief Take two clouds.
   * \param[in] scorer knows the surfaces
   * \param[in] source the points that take part, as they are
   * \param[in] target_size number of points of the target
   */
  void
  setClouds(const PoseScorer& scorer,
            const Eigen::Matrix3Xd& source,
            std::size_t target_size);

  /** \brief Whether there are clouds. */
  bool
  haveClouds() const;

  /** \brief Forget the clouds. */
  void
  forgetClouds();

  /** \brief Begin a run.
   * \param[in] pose where the run starts
   * \param[in] settings of the steps; the scale's bounds are those of the whole run
   * \param[in] goes_on whether it goes on from where the run before has been left, with
   * the same points
   */
  void
  start(const Eigen::Matrix4d& pose,
        const SurfaceStepSettings& settings,
        bool goes_on = false);

  /** \brief Make a step.
   * \return it; not found where points have no surface: another one may then be made,
   * see taken()
   */
  const SurfaceStep&
  step(const Matches& matches);

  /** \brief Take a step that somebody else has made from the same pairs.
   * \return it, turned about the axis that rotations are about
   */
  StoredPose
  taken(const StoredPose& transformation, const Matches& matches);

  /** \brief The last step. */
  const SurfaceStep&
  last() const;

  /** \brief How precise the pose of the last step is.
   * \param[in] center of the source where it has been placed
   */
  SurfacePrecision
  precision(const Eigen::Vector3d& center) const;

private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

} // namespace kss
} // namespace pcl
