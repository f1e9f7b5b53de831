/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include <pcl/registration/kss/alignment.h>
#include <pcl/registration/kss/detail/similarity.h>

#include "geometry/median.h"
#include "preparation/shape_pair.h"
#include "refinement/overlap.h"

#include <algorithm>

namespace pcl {
namespace kss {
namespace {

/** A transformation between the clouds as a pose between their pre-shapes. */
Similarity
poseOf(const Eigen::Matrix4d& transformation, const ShapePair& shapes)
{
  return shapes.target.simplified.T_cloud_shape().inverse() *
         Similarity::of(transformation) * shapes.source.simplified.T_cloud_shape();
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
    return {transformation, {}};
  return {transformation, overlapAt(*shapes_->source.all, *shapes_->target.all,
                                    poseOf(transformation, *shapes_))};
}

bool
PoseScorer::areSame(const Eigen::Matrix4d& a, const Eigen::Matrix4d& b) const
{
  return shapes_->metric.distance(poseOf(a, *shapes_), poseOf(b, *shapes_)) < same_pose;
}

double
PoseScorer::spacingAt(const Eigen::Matrix4d& transformation) const
{
  return std::max(scaleOf(transformation) * shapes_->source.simplified.size *
                      median(shapes_->source.all->spacing()),
                  shapes_->target.simplified.size *
                      median(shapes_->target.all->spacing()));
}

} // namespace kss
} // namespace pcl
