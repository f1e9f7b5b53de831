/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <cstddef>
#include <string>
#include <vector>

/** What is done to the models: Section V of the paper. */
namespace evaluation {

/** \brief How the source is turned. */
enum class Rotations {
  AXES, ///< the paper's: by more than 30 degrees about each axis
  SO3   ///< all rotations equally likely
};

/** \brief How the source's density is changed. */
enum class Resampling {
  GRADIENT, ///< half as many points, much denser at one end than at the other
  WLOP      ///< the paper's, CGAL's implementation: half as many points, evened out
};

/** \brief What all cases have in common. */
struct Protocol {
  unsigned int seed = 0;
  unsigned int repetitions = 1; ///< cases of each model and condition
  std::size_t points = 10000;   ///< of a cloud, where the condition does not say
  Rotations rotations = Rotations::AXES;
  double smallest_scale = 0.8, largest_scale = 1.2;
  double deleted = 0.3; ///< share of the source that is cut off
  Resampling resampling = Resampling::GRADIENT;
};

/** \brief What is done to one cloud pair, and the paper's table that it belongs to. */
struct Condition {
  std::string name;       ///< unique, as "gauss-0.66"
  std::string table;      ///< similarity, density, gauss, uniform, deleted, size
  double parameter = 0.0; ///< what the name's number says
  std::size_t points = 0; ///< of the target
  double gaussian = 0.0;  ///< sigma of the noise, in mean neighbour distances l_k
  double uniform = 0.0;   ///< largest displacement of the one-sided noise, in l_k
  double deleted = 0.0;   ///< share of the source that is cut off
  bool resampled = false; ///< whether the source's density is changed
};

/** \brief All conditions of the tables with these names, in the paper's order; those of
 * Table VI, the sizes, come last.
 * \throws std::runtime_error naming a table that there is not
 */
std::vector<Condition>
conditionsOf(const std::vector<std::string>& tables, const Protocol& protocol);

/** \brief The names of all tables. */
const std::vector<std::string>&
tableNames();

} // namespace evaluation
