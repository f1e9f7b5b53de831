/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/detail/surface_steps.h>
#include <pcl/registration/transformation_estimation_svd.h>

namespace pcl {
namespace kss {

/** \brief The transformation estimation of the final ICP: matched points are laid on
 * each other's tangent planes (\ref SurfaceSteps).
 *
 * Where that finds nothing, as where points have no surface, and outside of KSSICP, it
 * is PCL's estimation from points.
 */
template <typename PointSource, typename PointTarget, typename Scalar>
class SurfaceEstimation
: public registration::TransformationEstimationSVD<PointSource, PointTarget, Scalar> {
  using Base =
      registration::TransformationEstimationSVD<PointSource, PointTarget, Scalar>;

public:
  using typename Base::Matrix4;

  /** \brief What it steps by; without clouds it is PCL's estimation. */
  SurfaceSteps&
  steps()
  {
    return steps_;
  }

  using Base::estimateRigidTransformation;

  void
  estimateRigidTransformation(const PointCloud<PointSource>& source,
                              const PointCloud<PointTarget>& target,
                              const Correspondences& correspondences,
                              Matrix4& transformation) const override
  {
    if (!steps_.haveClouds()) {
      Base::estimateRigidTransformation(source, target, correspondences,
                                        transformation);
      return;
    }
    const Matches matches = matchesOf(source, target, correspondences);
    StoredPose move = steps_.step(matches).transformation;
    if (!steps_.last().is_found) {
      Base::estimateRigidTransformation(source, target, correspondences,
                                        transformation);
      move = steps_.taken(transformation.template cast<double>(), matches);
    }
    transformation = move.template cast<Scalar>();
  }

private:
  static Matches
  matchesOf(const PointCloud<PointSource>& source,
            const PointCloud<PointTarget>& target,
            const Correspondences& correspondences)
  {
    const auto size = correspondences.size();
    Matches matches{Eigen::Matrix3Xd(3, size), Eigen::Matrix3Xd(3, size), {}, {}};
    for (const Correspondence& pair : correspondences) {
      const auto i = static_cast<Eigen::Index>(matches.queries.size());
      matches.source.col(i) =
          source[pair.index_query].getVector3fMap().template cast<double>();
      matches.target.col(i) =
          target[pair.index_match].getVector3fMap().template cast<double>();
      matches.queries.push_back(pair.index_query);
      matches.matches.push_back(pair.index_match);
    }
    return matches;
  }

  mutable SurfaceSteps steps_;
};

} // namespace kss
} // namespace pcl
