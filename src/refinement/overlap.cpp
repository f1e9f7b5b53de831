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

/** How much of \a from, placed by \a placement, \a to covers; the spacing of \a from
 * times \a scale is that of the placed points. */
Share
shareOf(const NearestPoints& from,
        const NearestPoints& to,
        const Eigen::Affine3f& placement,
        float scale,
        Eigen::Index most)
{
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
  const Eigen::Affine3f placement = T_target_source.affine();
  const auto scale = static_cast<float>(T_target_source.scale);
  const Share forth = shareOf(source, target, placement, scale, most);
  const Share back = shareOf(target, source, placement.inverse(), 1.0f / scale, most);
  return {forth.covered, back.covered, forth.closeness + back.closeness};
}

} // namespace kss
} // namespace pcl
