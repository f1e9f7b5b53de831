/*
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * The steps of the choice among minima; their numbers, each beside its reason, are in
 * selection_steps.cpp. Lengths are in root mean square radii of the target.
 */

#pragma once

#include "refinement/refinement.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace pcl {
namespace kss {

/** \brief What a pose costs. */
enum class PoseCost {
  DISTANCE, ///< the truncated mean of the distances both ways: leads from afar
  OVERLAP,  ///< the less of the clouds lies on each other, the more: tells right from
            ///< wrong where they are complete
  SURFACES  ///< the less their surfaces speak for it, the more: tells right from wrong
            ///< where much is hidden, or large and flat
};

/** \brief A step of the choice: poses are refined, and those that are distinct ranked.
 */
struct SelectionStep {
  /** \brief Poses that are taken to it, the best ones. */
  std::size_t most;
  /** \brief How they are refined. */
  Refinement::Effort effort;
  /** \brief What ranks them. */
  PoseCost cost;
  /** \brief Points that tell the cost. */
  Eigen::Index cost_probes;
  /** \brief Of poses closer together than this one is kept. */
  double distinct;

  /** \brief What a distance counts at most, where that is the cost. */
  double limit = 0.0;
  /** \brief Only poses whose overlap is at least that share of the best are taken;
   * none: all. The step before has ranked by overlap. */
  std::optional<double> hope = {};
  /** \brief Whether each pose is tried turned a little about each axis, too. */
  bool turned = false;
  /** \brief Whether probes are taken from all of the clouds, or from the simplified
   * ones. */
  bool on_clouds = false;
};

/** \brief Poses that are listed in the end. */
constexpr std::size_t most_alternatives = 5;

/** \brief Points of each cloud whose correspondences decide in the end. */
constexpr Eigen::Index most_probes = 2500;

/** \brief How many of the minima are looked into, and from how far. */
struct SelectionEffort {
  /** \brief How far candidates can leave points off. */
  double reach;
  /** \brief Poses after the first step, on the surfaces, and in the end. */
  std::size_t near, on_surfaces, last;
  /** \brief What a distance counts at most where poses are ranked, in the first step
   * and in the second one. */
  double first_limit, second_limit;
  /** \brief What the lengths of the steps are multiples of: the larger cloud's root
   * mean square radius, in those of the target. */
  double unit = 1.0;
  /** \brief Whether all that is known of the clouds' surfaces takes part: an object in
   * a scene is smaller than the spacing of fewer points. */
  bool is_dense = false;
};

/** \brief The first steps, from as far as a candidate can be off.
 * \param[in] effort
 * \param[in] samples points of the simplified target
 */
std::vector<SelectionStep>
stepsFromAfar(const SelectionEffort& effort, Eigen::Index samples);

/** \brief The last steps, on the surfaces.
 * \param[in] effort
 * \param[in] spacing of the points of the clouds
 * \param[in] samples points of the simplified target
 * \param[in] is_noisy whether heavy noise has been averaged away
 */
std::vector<SelectionStep>
stepsOnSurfaces(const SelectionEffort& effort,
                double spacing,
                Eigen::Index samples,
                bool is_noisy);

} // namespace kss
} // namespace pcl
