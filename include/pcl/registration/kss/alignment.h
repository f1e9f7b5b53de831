/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/hausdorff.h>
#include <pcl/registration/kss/points.h>
#include <pcl/registration/kss/pre_shape.h>
#include <pcl/registration/kss/settings.h>
#include <pcl/registration/kss/stage_seconds.h>

#include <memory>
#include <string>
#include <vector>

namespace pcl {
namespace kss {

/** \brief A pose that competes to be the result. */
struct Alternative {
  /** \brief The similarity that maps the source onto the target. */
  Eigen::Matrix4d transformation;
  /** \brief Its energy (e9): the Hausdorff distance of the simplified clouds, as a
   * fraction of the target's root mean square radius. */
  double energy;
};

/** \brief Poses by rising energy. */
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

  /** \brief Set the two clouds: simplifies them and maps them to pre-shape space.
   * \param[in] source cloud to be placed
   * \param[in] target cloud to be placed upon
   * \param[in] known_scale the scale of all poses where the settings do not have it
   * estimated
   * \throws std::invalid_argument where a cloud does not determine a pose
   */
  void
  setClouds(const LocalCloud& source, const LocalCloud& target, double known_scale);

  /** \brief Search all candidates and refine the best. */
  Alternatives
  align();

  /** \brief The pose with its energy, which ranks it among the alternatives. */
  Alternative
  judge(const Eigen::Matrix4d& transformation);

  /** \brief The mean distance of the simplified clouds, both ways, at a pose: a
   * multiple of the distance between neighbouring samples.
   */
  double
  residual(const Eigen::Matrix4d& transformation);

  /** \brief Whether two poses are the same for the purpose of listing alternatives. */
  bool
  same(const Eigen::Matrix4d& a, const Eigen::Matrix4d& b) const;

  /** \brief The name of the device that evaluates the candidates. */
  std::string
  deviceName() const;

  /** \brief Wall time by stage since setClouds(). */
  StageClock&
  clock();

private:
  using Poses = std::vector<Eigen::Matrix4d>;

  Alternatives
  refined(const Poses& minima);

  Poses
  distinctByEnergy(const Poses& poses);

  double
  displacement(const Eigen::Matrix4d& a, const Eigen::Matrix4d& b) const;

  std::vector<HausdorffDistances>
  distancesOf(const Poses& poses);

  std::vector<float>
  energiesOf(const Poses& poses);

  void
  report(const char* stage, double done) const;

  Settings settings_;
  std::unique_ptr<HausdorffEvaluator> evaluator_;
  PreShape source_, target_;
  double sampling_distance_ = 0.0;
  StageClock clock_;
};

} // namespace kss
} // namespace pcl
