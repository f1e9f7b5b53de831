/*
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * The final ICP, on the clouds themselves: T of (e11), and the result among the poses
 * that compete for it.
 */

#pragma once

#include <pcl/registration/kss/alignment.h>
#include <pcl/registration/kss/detail/points.h>
#include <pcl/registration/kss/detail/surface_step.h>
#include <pcl/registration/kss/export.h>
#include <pcl/registration/kss/failure.h>
#include <pcl/registration/kss/result.h>
#include <pcl/registration/kss/settings.h>
#include <pcl/registration/kss/stages.h>

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace pcl {
namespace kss {

/** \brief With so many points of the source most of the way is made: what is left is
 * their standard error. */
constexpr std::size_t points_of_first_steps = 2000;

/** \brief Steps smaller than this share of the pose's standard errors, root mean square
 * over its directions, are at rest. */
constexpr double at_rest = 0.1;

/** \brief A part of the final ICP. */
struct FinalStep {
  /** \brief Whether all points of the source take part that do in the end; otherwise
   * \ref points_of_first_steps of them. */
  bool has_all_points;
  /** \brief Iterations at most. */
  int iterations;
  /** \brief How far the logarithm of the odds may then be behind the rival's for the
   * run to go on. */
  double most_behind;
};

/** \brief Where a run of the final ICP ended. */
struct PCL_KSS_ICP_EXPORT FinalRun {
  FinalRun() = default;
  FinalRun(const FinalRun&) = default;
  FinalRun&
  operator=(const FinalRun&) = default;
  virtual ~FinalRun();

  /** \brief The similarity that maps the source onto the target. */
  StoredPose transformation = StoredPose::Identity();
  int iterations = 0;     ///< with all points
  bool converged = false; ///< whether it has come to rest
  /** \brief Whether its last iteration found fewer pairs than a pose takes. */
  bool has_too_few_pairs = false;
  SurfacePrecision precision;
};

/** \brief What the iterations of a part go by. */
struct FinalStepSettings {
  SurfaceStepSettings surfaces;
  /** \brief How long correspondences may be; may be infinite. */
  double reach;
  /** \brief Whether the part goes on from where the one before has been left, with the
   * same points. */
  bool goes_on;
  /** \brief Told how many iterations the part has made. */
  std::function<void(int)> made;
};

/** \brief An ICP for two clouds, in whatever form they are held. */
class PCL_KSS_ICP_EXPORT FinalICP {
public:
  virtual ~FinalICP();

  /** \brief Iterate.
   * \param[in,out] pose from where, and to where
   * \param[out] iterations how many there were
   * \return whether they have led to a pose
   */
  virtual bool
  iterate(const FinalStep& step,
          const FinalStepSettings& settings,
          StoredPose& pose,
          int& iterations) = 0;

  /** \brief What the last iterations have left, their own number aside.
   * \param[in] is_pose whether that is a pose
   */
  virtual std::shared_ptr<FinalRun>
  lastRun(bool is_pose) = 0;
};

/** \brief A pose that competes to be the result; one that the search found has no run
 * of the final ICP yet.
 */
struct FinalContender {
  Alternative alternative;
  std::shared_ptr<FinalRun> run = {};
  bool is_guess = false; ///< whether it began with the guess, which keeps its scale
};

/** \brief What the final stage has to know of the clouds. */
struct FinalClouds {
  /** \brief Points of the source that take part. */
  std::size_t points = 0;
  /** \brief Iterations at most, of a run: at least one. */
  int iterations = 1;
  /** \brief The distance of two points that rounding alone accounts for. */
  double rounding_error = 0.0;
  /** \brief The mean of the source's points. */
  Eigen::Vector3d source_centroid = Eigen::Vector3d::Zero();
};

/** \brief The choice among the poses that an alignment has found, by the final ICP. */
class PCL_KSS_ICP_EXPORT FinalStage {
public:
  /** \param[in] settings mode and scale
   * \param[in] scorer of the clouds
   * \param[in] clouds what they are
   * \param[in] icp runs on them; kept by reference
   * \param[in] stages whose present one this is; kept by reference
   */
  FinalStage(const Settings& settings,
             const PoseScorer& scorer,
             const FinalClouds& clouds,
             FinalICP& icp,
             const Stages& stages);

  /** \brief Run the final ICP from the guess and from all poses that may be right.
   * \param[in] alternatives at least one, the likeliest first
   * \param[in] guess a similarity; none: there is none
   * \return the contenders, at least one, the one that the surfaces speak for most
   * first
   * \throws RegistrationError where that one finds no pairs of points to begin with
   */
  std::vector<FinalContender>
  settle(const Alternatives& alternatives, const std::optional<StoredPose>& guess);

  /** \brief Make one step of the final ICP, at a known scale, from a pose.
   * \return where it leads, and how precisely the points that match at the pose say so
   */
  FinalRun
  stepFrom(const StoredPose& pose);

  /** \brief Why the work came to no end; empty if it did. */
  const std::string&
  stopped() const
  {
    return stopped_;
  }

private:
  /** \brief Run the final ICP from all contenders that may be right. */
  void
  runAll(std::vector<FinalContender>& contenders);

  /** \brief IterativeClosestPoint on the clouds themselves: T of (e11).
   * \param[in] steps from few points to all
   * \param[in] contender where to start
   * \param[in] estimate_scale whether the scale may change where it is estimated
   * \param[in] rival what the result competes with: where a step leaves it behind, that
   * is all of its run; null: nothing
   * \param[in] has_skins whether half of the source may have its nearest points on
   * another skin of the target
   */
  FinalContender
  run(const std::vector<FinalStep>& steps,
      const Alternative& contender,
      bool estimate_scale,
      const Alternative* rival = nullptr,
      bool has_skins = false);

  /** \brief From few points, with which most of the way is made, to all of them, and
   * from as many iterations as right poses take to as many as may be made. */
  std::vector<FinalStep>
  steps() const;

  /** \brief All points, and as many iterations as there may be. */
  FinalStep
  whole() const;

  SurfaceStepSettings
  surfaceStepSettings(bool estimate_scale, bool has_skins) const;

  /** \brief The contender on a skin beside it, or between which it has come to rest,
   * where that explains more. */
  FinalContender
  onSkinBeside(const FinalContender& contender);

  /** \brief The contender at scale 1 where that explains the clouds as well: metric
   * data must not lose accuracy to a scale that is free. */
  FinalContender
  atScaleOne(const FinalContender& contender);

  /** \brief Of contenders that are as good as the first one, put the one first that is
   * nearest to the guess. */
  void
  preferNearest(const StoredPose& guess, std::vector<FinalContender>& contenders) const;

  Settings settings_;
  PoseScorer scorer_;
  FinalClouds clouds_;
  FinalICP& icp_;
  const Stages& stages_;
  int runs_ = 0; ///< of ICP that have begun
  std::string stopped_;
};

/** \brief The distinct poses among the contenders, in their order. */
PCL_KSS_ICP_EXPORT Alternatives
distinctPoses(const std::vector<FinalContender>& contenders, const PoseScorer& scorer);

/** \brief What keeps a result from being one that can be relied on; nothing: it is.
 * \param[in] settings the confidence that is asked for
 * \param[in] alternatives the result first
 * \param[in] run of the result; null: it has none
 * \param[in] stopped why the work came to no end; empty if it did
 * \param[in] whatWouldFit asked for one sentence where nothing fits; empty: none; says
 * nothing where nothing would
 */
PCL_KSS_ICP_EXPORT Failure
failureOf(const Settings& settings,
          const Alternatives& alternatives,
          const FinalRun* run,
          const std::string& stopped,
          const std::function<std::string()>& whatWouldFit);

} // namespace kss
} // namespace pcl
