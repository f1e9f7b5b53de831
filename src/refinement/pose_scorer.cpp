/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include <pcl/registration/kss/alignment.h>
#include <pcl/registration/kss/detail/similarity.h>

#include "geometry/turns.h"
#include "preparation/shape_pair.h"
#include "refinement/overlap.h"
#include "surfaces/evidence.h"
#include "surfaces/skins.h"

#include <algorithm>
#include <cmath>

namespace pcl {
namespace kss {
namespace {

/** Points of each cloud that tell how much the clouds overlap. */
constexpr Eigen::Index most_tellers = 4000;

/** A transformation between the clouds as a pose between their pre-shapes. */
Similarity
poseOf(const Eigen::Matrix4d& transformation, const ShapePair& shapes)
{
  return shapes.target.simplified.T_cloud_shape().inverse() *
         Similarity::of(transformation) * shapes.source.simplified.T_cloud_shape();
}

/** The normals of a shape where it is nearest to positions in its cloud's frame. */
void
takeNormals(const Shape& shape, const Eigen::Matrix3Xd& positions, Points& normals)
{
  const Similarity T_shape_cloud = shape.simplified.T_cloud_shape().inverse();
  for (Eigen::Index i = 0; i < positions.cols(); ++i) {
    const Eigen::Vector3d placed =
        T_shape_cloud.linear() * positions.col(i) + T_shape_cloud.translation;
    float squared_distance;
    normals.col(i) = shape.surface.planes.normals.col(
        shape.surface.points->nearest(placed.cast<float>(), squared_distance));
  }
}

/** Of a plane through a dozen points whose noise is known: they lie a spacing off its
 * axes, root mean square, and it can be off about both. */
double
normalErrorOf(const Shape& shape)
{
  constexpr double points = 13.0;
  return shape.surface.planes.noise / shape.surface.points->usualSpacing() *
         std::sqrt(2.0 / points);
}

} // namespace

PoseScorer::PoseScorer(std::shared_ptr<const ShapePair> shapes)
: shapes_(std::move(shapes))
{
}

Alternative
PoseScorer::scored(const Eigen::Matrix4d& transformation) const
{
  if (!isSimilarity(transformation) ||
      !isDetermined(shapes_->source.extent, shapes_->target.extent,
                    scaleOf(transformation)))
    return {transformation, {}, {}};
  const Similarity pose = poseOf(transformation, *shapes_);
  return {transformation,
          overlapAt(*shapes_->source.all, *shapes_->target.all, pose, most_tellers),
          evidenceAt(shapes_->source.surface, shapes_->target.surface, pose,
                     shapes_->scales.smallest < shapes_->scales.largest)};
}

bool
PoseScorer::areSame(const Eigen::Matrix4d& a, const Eigen::Matrix4d& b) const
{
  return distance(a, b) < same_pose;
}

double
PoseScorer::distance(const Eigen::Matrix4d& a, const Eigen::Matrix4d& b) const
{
  return shapes_->metric.distance(poseOf(a, *shapes_), poseOf(b, *shapes_));
}

std::optional<StoredPose>
PoseScorer::skinBeside(const Eigen::Matrix4d& transformation) const
{
  if (shapes_->is_noisy)
    return {};
  const std::optional<Similarity> pose = kss::skinBeside(
      shapes_->source.surface, shapes_->target.surface,
      poseOf(transformation, *shapes_), shapes_->scales, turnsOf(shapes_->axis));
  if (!pose)
    return {};
  return StoredPose((shapes_->target.simplified.T_cloud_shape() * *pose *
                     shapes_->source.simplified.T_cloud_shape().inverse())
                        .matrix());
}

double
PoseScorer::spacingAt(const Eigen::Matrix4d& transformation) const
{
  return std::max(scaleOf(transformation) * shapes_->source.simplified.size *
                      shapes_->source.all->usualSpacing(),
                  shapes_->target.simplified.size *
                      shapes_->target.all->usualSpacing());
}

void
PoseScorer::sourceNormals(const Eigen::Matrix3Xd& positions, Points& normals) const
{
  takeNormals(shapes_->source, positions, normals);
}

void
PoseScorer::targetNormals(const Eigen::Matrix3Xd& positions, Points& normals) const
{
  takeNormals(shapes_->target, positions, normals);
}

double
PoseScorer::sourceNormalError() const
{
  return normalErrorOf(shapes_->source);
}

double
PoseScorer::targetNormalError() const
{
  return normalErrorOf(shapes_->target);
}

} // namespace kss
} // namespace pcl
