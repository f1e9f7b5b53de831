/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "method.h"

#include <string>
#include <vector>

namespace evaluation {

/** \brief One choice within KSS-ICP, and what else might have been chosen. */
struct Ablation {
  std::string flag;  ///< as in --ablate-rotations
  std::string title; ///< what is changed
  /** KSS-ICP as shipped, but for that. */
  std::vector<Method> variants;
};

/** \brief All of them. */
std::vector<Ablation>
ablations();

} // namespace evaluation
