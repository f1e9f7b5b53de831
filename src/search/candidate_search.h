/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "candidates/sweeps.h"
#include "evaluators/distance_evaluator.h"
#include "geometry/pose_metric.h"
#include "search/screening.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace pcl {
namespace kss {

/** \brief The energies of all candidates from all pairs of points: what other searches
 * are measured against. */
constexpr auto brute_force = static_cast<Search>(-1);

/** \brief A local minimum of an energy: a pose between the pre-shapes. */
struct Minimum {
  Similarity pose;
  float energy;
  Weights weights;
};

/** \brief The search over {C} x {O}: (e10), (e13) and the minima of (e12). */
class CandidateSearch {
public:
  /** \param[in] settings copied
   * \throws DeviceError where the device asked for cannot be had
   */
  explicit CandidateSearch(const Settings& settings);

  /** \brief The distinct local minima of all energies of the mode; (c_init, O_init),
   * the lowest of all, comes first.
   * \param[in] source a pre-shape, in the order of farthest points
   * \param[in] target as the source
   * \param[in] scales what to consider
   * \param[in] metric tells which poses are distinct
   * \param[in] grain how close candidates lie, and how many are looked into
   * \param[in] done told the share of the work that is done
   * \return at least one; those of the first sweeps where the rest has been stopped
   * \throws Stopped before there are any
   */
  std::vector<Minimum>
  localMinima(const Points& source,
              const Points& target,
              const ScaleRange& scales,
              const PoseMetric& metric,
              const Grain& grain,
              const std::function<void(double)>& done);

  /** \brief The energy of one pose of the clouds of the last localMinima(). */
  float
  energyAt(const Similarity& pose, const Weights& weights);

  /** \brief The name of the device that does the work. */
  std::string
  deviceName() const;

private:
  /** \brief The minima of one sweep. */
  std::vector<Minimum>
  minimaOf(const Sweep& sweep,
           const PoseMetric& metric,
           const Grain& grain,
           const std::function<void(double)>& done);

  /** \brief Minima among the candidates that screening finds. */
  std::vector<Minimum>
  screened(const Sweep& sweep, const PoseMetric& metric, const Grain& grain);

  /** \brief The minima of brute force, by bounds. */
  std::vector<Minimum>
  exact(const Sweep& sweep, const Grain& grain);

  /** \brief Minima after the energies of all candidates. */
  std::vector<Minimum>
  evaluated(const Sweep& sweep,
            const Grain& grain,
            const std::function<void(double)>& done);

  Settings settings_;
  std::unique_ptr<DistanceEvaluator> evaluator_;
  std::optional<Screening> screening_;
  Points source_, target_;
};

} // namespace kss
} // namespace pcl
