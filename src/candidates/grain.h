/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "candidates/numbers.h"

#include <cstddef>

namespace pcl {
namespace kss {

/** \brief How finely candidates are laid and compared. */
struct Grain {
  /** \brief The centres of two parts. */
  search_numbers::CenterGrid two_parts;
  /** \brief Candidates of a sweep at most; more centres would lie farther apart. */
  double most_candidates;
  /** \brief What a distance counts in a mean at most, in root mean square radii of the
   * target. */
  float limit;
  /** \brief Candidates of a sweep that are evaluated after screening, about. */
  std::size_t screened;
  /** \brief Minima of an energy that are refined at most. */
  std::size_t minima;
  /** \brief Whether the smaller cloud is looked for in the larger one, which owes it
   * nothing. */
  bool in_scene = false;
};

} // namespace kss
} // namespace pcl
