/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "centred_pair.h"

namespace evaluation {

/** \brief How ICP ends what another method has begun. */
struct Refinement {
  bool with_scale = false;
  /** Points of the source with no neighbour this near do not count, in one ICP after
   * the other; shares of the target's diagonal. The first suffices for what a coarse
   * alignment leaves; the last leaves out what only one of the clouds shows.
   */
  std::vector<double> reaches{0.1, 0.03};
};

/** \brief IterativeClosestPoint on the full clouds, each time until the mean squared
 * error changes by less than 1e-5 of itself, or for 50 iterations.
 * \param[in] guess from the centred source to the centred target
 */
Answer
refine(const CentredPair& pair,
       const Eigen::Matrix4f& guess,
       const Refinement& refinement);

/** \brief A coarse registration that has been given the clouds of a pair, and then
 * refine().
 */
template <typename Coarse>
Answer
alignAndRefine(Coarse& coarse, const CentredPair& pair)
{
  Cloud aligned;
  coarse.align(aligned);
  Answer answer = refine(pair, coarse.getFinalTransformation(), {});
  answer.claimed = answer.claimed && coarse.hasConverged();
  return answer;
}

} // namespace evaluation
