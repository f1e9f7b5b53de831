/*
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * The levels at which poses are searched for, from coarse to fine.
 */

#pragma once

#include <pcl/registration/kss/settings.h>

#include "candidates/grain.h"
#include "preparation/shape_pair.h"
#include "refinement/selection_steps.h"

#include <vector>

namespace pcl {
namespace kss {

/** \brief A search over {C} x {O} and the choice among its minima. */
struct SearchLevel {
  /** \brief What goes before the names of its stages: "", "finer ". */
  const char* prefix;
  Grain grain;
  SelectionEffort selection;
  /** \brief The logarithm of the odds from which on a pose needs no finer level. */
  double convincing;
};

/** \brief The levels, in the order in which they are tried until one has found a pose
 * that convinces; never empty.
 *
 * Complete objects, parts of them, and whatever shares most of its surface are found at
 * the first level. Scenes share less, and what is not their ground or their walls is
 * smaller than its steps: where the scale is known, a finer level follows. An object in
 * a scene takes one of its own, whose steps are those of the object.
 * \param[in] settings mode, scale and sets of candidates
 * \param[in] shapes whose sizes tell an object from a scene
 * \throws std::invalid_argument where an object is to be found in a scene at an unknown
 * scale
 */
std::vector<SearchLevel>
levelsFor(const Settings& settings, const ShapePair& shapes);

} // namespace kss
} // namespace pcl
