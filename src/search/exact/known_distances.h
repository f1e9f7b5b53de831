/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "candidates/candidates.h"
#include "evaluators/bounds.h"
#include "evaluators/distance_evaluator.h"

#include <cstdint>
#include <vector>

namespace pcl {
namespace kss {

/** \brief How many candidates were evaluated in which way. */
struct SearchEffort {
  /** \brief Candidates whose bounds were looked up with so many points. */
  struct Level {
    Eigen::Index probes;
    std::size_t candidates;
  };
  std::vector<Level> levels;
  /** \brief Candidates that all pairs of points were needed for. */
  std::size_t exact = 0;
};

/** \brief What is known of the distances of all candidates, and how more is learned: at
 * each level bounds from twice as many points as at the one before, then from all, and
 * last the distances themselves.
 */
class KnownDistances {
public:
  /** \param[in] candidates all
   * \param[in] points of the larger cloud
   * \param[in] bounds where the clouds are set
   * \param[in] distances where the clouds are set; brute force
   */
  KnownDistances(const Candidates& candidates,
                 Eigen::Index points,
                 BoundsEvaluator& bounds,
                 DistanceEvaluator& distances);

  /** \brief The level that a candidate has reached; 0 where nothing is known. */
  int
  level(std::size_t candidate) const
  {
    return level_[candidate];
  }

  /** \brief The level of the closest bounds. */
  int
  closest() const
  {
    return static_cast<int>(effort_.levels.size());
  }

  /** \brief The level of brute force's distances. */
  int
  exact() const
  {
    return closest() + 1;
  }

  /** \brief Between these lie the distances of a candidate. */
  const DistanceBounds&
  operator[](std::size_t candidate) const
  {
    return known_[candidate];
  }

  /** \brief Bring candidates that have not reached a level to it.
   * \return all candidates of which more is known now
   */
  std::vector<std::size_t>
  raise(const std::vector<std::size_t>& candidates, int level);

  /** \brief What it took so far. */
  const SearchEffort&
  effort() const
  {
    return effort_;
  }

private:
  std::vector<std::size_t>
  bound(const std::vector<std::size_t>& candidates, int level);

  std::vector<std::size_t>
  compute(const std::vector<std::size_t>& candidates);

  const Candidates& candidates_;
  BoundsEvaluator& bounds_;
  DistanceEvaluator& distances_;
  std::size_t row_size_;           ///< candidates of a rotation
  std::vector<std::size_t> first_; ///< of each rotation, that is the same
  std::vector<std::size_t> next_;  ///< of each rotation, that is the same; or none
  std::vector<std::uint8_t> level_;
  std::vector<DistanceBounds> known_;
  SearchEffort effort_;
};

} // namespace kss
} // namespace pcl
