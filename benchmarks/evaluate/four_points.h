/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "../fpfh.h"
#include "centred_pair.h"

#include <algorithm>

/** What FPCS and KFPCS have in common. */
namespace evaluation {

/** \brief Both clouds, thinned, with normals. The four points are taken from the target
 * and looked for in the source, among all pairs of its points: the work grows with the
 * fourth power of their number. The target may have more, so that aligned points are
 * near a neighbour.
 */
struct FourPointsPair {
  /** \param[in] points that the source may have, about */
  FourPointsPair(const CentredPair& pair, std::size_t points);

  float leaf = 0.0f; ///< edge length of the cells by which the source is thinned
  benchmarks::Described source, target; ///< without features
};

/** \brief How many times four points are tried: the smaller the overlap, the less often
 * all of them lie in what both clouds show.
 */
int
trialsFor(double overlap);

/** \brief Set what both have.
 * \param[in] delta how exactly points lie on each other, in leaves of the source
 * \param[in] score by which it ends early; 0 is perfect, 1 useless
 */
template <typename Registration>
void
configure(Registration& registration,
          const FourPointsPair& pair,
          double overlap,
          float delta,
          float score)
{
  registration.setInputSource(pair.source.points);
  registration.setInputTarget(pair.target.points);
  registration.setSourceNormals(pair.source.normals);
  registration.setTargetNormals(pair.target.normals);
  registration.setMaxNormalDifference(15.0f);
  registration.setApproxOverlap(static_cast<float>(std::min(overlap, 0.9)));
  registration.setDelta(delta * pair.leaf, false);
  registration.setScoreThreshold(score);
  registration.setMaximumIterations(trialsFor(overlap));
}

} // namespace evaluation
