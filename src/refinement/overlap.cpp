/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "refinement/overlap.h"

#include "geometry/take.h"

#include "geometry/pre_shape.h"

#include <algorithm>
#include <cmath>

namespace pcl {
namespace kss {
namespace {

struct Share {
  double covered = 0.0, closeness = 0.0;
};

/** How much of \a from, placed, \a to covers. */
Share
shareOf(const NearestPoints& from,
        const NearestPoints& to,
        const Similarity& T_to_from,
        Eigen::Index most)
{
  const Eigen::Affine3f placement = T_to_from.affine();
  const auto scale = static_cast<float>(T_to_from.scale); // of the spacing, too
  Share share;
  const Eigen::Index size = from.points().cols(), count = std::min(most, size);
  for (Eigen::Index n = 0; n < count; ++n) {
    const Eigen::Index i = evenlySpaced(n, count, size);
    float squared;
    const int nearest = to.nearest(placement * from.points().col(i), squared);
    const float spacing = std::max(scale * from.spacing()[i], to.spacing()[nearest]);
    const float tolerance = spacing * spacing;
    share.covered += squared <= covered * covered * tolerance;
    if (squared < tolerance)
      share.closeness += 1.0f - squared / tolerance;
  }
  share.covered /= count;
  share.closeness /= count;
  return share;
}

} // namespace

Overlap
overlapAt(const NearestPoints& source,
          const NearestPoints& target,
          const Similarity& T_target_source,
          Eigen::Index most)
{
  const Share forth = shareOf(source, target, T_target_source, most);
  const Share back = shareOf(target, source, T_target_source.inverse(), most);
  return {forth.covered, back.covered, forth.closeness + back.closeness};
}

} // namespace kss
} // namespace pcl
