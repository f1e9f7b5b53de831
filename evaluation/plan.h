/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "models.h"
#include "options.h"
#include "run.h"

#include <vector>

namespace evaluation {

/** \brief A method as it is run, and what it is there for. */
struct PlannedMethod {
  Method method;
  std::string group;   ///< kss, peer or ablation
  std::string ablates; ///< title of the ablation
};

/** \brief All that is to be done. */
struct Plan {
  std::vector<Model> models, size_models;
  std::vector<Condition> conditions;
  std::vector<PlannedMethod> methods;
};

/** \brief Choose models, conditions and methods.
 * \throws std::runtime_error naming a method that there is not
 */
Plan
planFor(const Options& options, const ModelFolder& folder);

/** \brief Every method on every case of the conditions of equal size, model by model:
 * without the scale, and, but for ablations, told the scale.
 */
std::vector<Run>
runsOfTables(const Plan& plan, const Protocol& protocol);

/** \brief The methods on clouds of growing size, method by method. Those that cannot
 * estimate the scale are told it, the others are not.
 */
std::vector<Run>
runsOfSizes(const Plan& plan);

} // namespace evaluation
