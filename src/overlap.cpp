/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include <pcl/registration/kss/overlap.h>
#include <pcl/registration/kss/pre_shape.h>

#include <algorithm>
#include <cmath>

namespace pcl {
namespace kss {
namespace {

/** In spacings: of random points on a surface, one in a thousand has no point of
 * another such sampling within this distance. */
constexpr float covered = 1.5f;

struct Share {
  double covered = 0.0, closeness = 0.0;
};

/** How much of \a from, placed by \a placement, \a to covers; the spacing of \a from
 * times \a scale is that of the placed points. */
Share
shareOf(const NearestPoints& from,
        const NearestPoints& to,
        const Eigen::Affine3f& placement,
        float scale)
{
  Share share;
  for (Eigen::Index i = 0; i < from.points().cols(); ++i) {
    float squared;
    const int nearest = to.nearest(placement * from.points().col(i), squared);
    const float spacing = std::max(scale * from.spacing()[i], to.spacing()[nearest]);
    const float tolerance = spacing * spacing;
    share.covered += squared <= covered * covered * tolerance;
    if (squared < tolerance)
      share.closeness += 1.0f - squared / tolerance;
  }
  share.covered /= from.points().cols();
  share.closeness /= from.points().cols();
  return share;
}

} // namespace

Overlap
overlapAt(const NearestPoints& source,
          const NearestPoints& target,
          const Eigen::Matrix4d& pose)
{
  const Eigen::Affine3f placement(pose.cast<float>());
  const auto scale = static_cast<float>(scaleOf(pose));
  const Share forth = shareOf(source, target, placement, scale);
  const Share back = shareOf(target, source, placement.inverse(), 1.0f / scale);
  return {forth.covered, back.covered, forth.closeness + back.closeness};
}

} // namespace kss
} // namespace pcl
