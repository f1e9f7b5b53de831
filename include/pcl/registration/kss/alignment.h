/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/candidate_search.h>
#include <pcl/registration/kss/determinacy.h>
#include <pcl/registration/kss/nearest_points.h>
#include <pcl/registration/kss/overlap.h>
#include <pcl/registration/kss/points.h>
#include <pcl/registration/kss/pre_shape.h>
#include <pcl/registration/kss/preparation.h>
#include <pcl/registration/kss/selection.h>
#include <pcl/registration/kss/settings.h>
#include <pcl/registration/kss/stage_seconds.h>
#include <pcl/registration/kss/sweeps.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace pcl {
namespace kss {

/** \brief A pose that competes to be the result. */
struct Alternative {
  /** \brief The similarity that maps the source onto the target. */
  StoredPose transformation;
  /** \brief How much of the clouds lies on each other there. */
  Overlap overlap;
};

/** \brief Poses by falling score of their overlap. */
using Alternatives = std::vector<Alternative>;

/** \brief The alignment stage of KSS-ICP: from two clouds to the distinct poses at
 * which they resemble each other most, without a guess (Algorithm 1 of the paper up to
 * the ICP on the clouds themselves).
 */
class Alignment {
public:
  /** \param[in] settings copied
   * \throws DeviceError where the device asked for cannot be had
   */
  explicit Alignment(const Settings& settings);

  // in the library, which has allocated what is in here: a program compiled for other
  // vectors would free it otherwise
  ~Alignment();

  /** \brief Set the two clouds: cleans and simplifies them and maps them to pre-shape
   * space. What a cloud that has not changed since the last call needs is kept.
   * \param[in] source cloud to be placed
   * \param[in] target cloud to be placed upon
   * \param[in] known_scale the scale of all poses where the settings do not have it
   * estimated
   * \throws std::invalid_argument where a cloud does not determine a pose
   */
  void
  setClouds(const LocalCloud& source, const LocalCloud& target, double known_scale);

  /** \brief What the work is done with. */
  const Settings&
  settings() const
  {
    return settings_;
  }

  /** \brief Have another function told how far the work has come. */
  void
  setProgress(const ProgressCallback& progress)
  {
    settings_.progress = progress;
  }

  /** \brief Search all candidates and refine the best.
   * \return at least one; as far as they have come where the work has been stopped
   * \throws Stopped before any pose has been found
   */
  Alternatives
  align();

  /** \brief Throw where the clouds determine no pose of a scale; setClouds() has done
   * so for the scale that comes nearest to making them equally large.
   * \throws std::invalid_argument
   */
  void
  throwIfUndetermined(double scale) const;

  /** \brief A transformation with its overlap, which ranks it among the alternatives;
   * none where it is no similarity, or one of a scale that determines no pose.
   */
  Alternative
  judge(const Eigen::Matrix4d& transformation) const;

  /** \brief Whether two transformations are the same for the purpose of listing
   * alternatives. */
  bool
  same(const Eigen::Matrix4d& a, const Eigen::Matrix4d& b) const;

  /** \brief The spacing of the points of both clouds where a transformation has placed
   * the source: the wider one, median, in units of the target. */
  double
  spacing(const Eigen::Matrix4d& transformation) const;

  /** \brief The name of the device that evaluates the candidates. */
  std::string
  deviceName() const;

  /** \brief Wall time by stage since setClouds(). */
  StageClock&
  clock();

private:
  void
  prepare(PreparedCloud& prepared_cloud, const LocalCloud& cloud);

  void
  toPreShapeSpace(const PreparedCloud& source,
                  const PreparedCloud& target,
                  double known_scale);

  /** \brief Whether a pose makes the additional process of (e12) unnecessary. */
  bool
  isGoodEnough(const JudgedPose& judged, const Weights& weights);

  ScaleRange
  scaleRange() const;

  void
  report(const char* stage, double done) const;

  Settings settings_;
  CandidateSearch search_;
  PreparedCloud source_cloud_, target_cloud_;
  CloudSize source_size_{}, target_size_{};
  std::optional<Shape> source_, target_;
  std::optional<PoseMetric> metric_;
  bool is_noisy_ = false;
  StageClock clock_;
};

} // namespace kss
} // namespace pcl
