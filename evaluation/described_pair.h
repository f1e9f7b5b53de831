/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "../benchmarks/fpfh.h"
#include "centred_pair.h"

namespace evaluation {

/** \brief Both clouds, thinned and described for methods that match features. */
struct DescribedPair {
  explicit DescribedPair(const CentredPair& pair);

  float leaf; ///< edge length of the cells by which the clouds are thinned
  benchmarks::Described source, target;
};

/** \brief Give a registration clouds and features. */
template <typename Registration>
void
setInput(Registration& registration, const DescribedPair& pair)
{
  registration.setInputSource(pair.source.points);
  registration.setSourceFeatures(pair.source.features);
  registration.setInputTarget(pair.target.points);
  registration.setTargetFeatures(pair.target.features);
}

/** \brief A thirtieth of the target's diagonal, or more where a cloud is so sparse that
 * a cell would hold less than about a point.
 * \param[in] source_scale by which the source is to be multiplied first
 */
float
leafFor(const CentredPair& pair, float source_scale = 1.0f);

} // namespace evaluation
