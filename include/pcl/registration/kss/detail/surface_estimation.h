/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/alignment.h>
#include <pcl/registration/kss/detail/surface_step.h>
#include <pcl/registration/transformation_estimation_svd.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace pcl {
namespace kss {

/** \brief The transformation estimation of the final ICP: matched points are laid on
 * each other's tangent planes (surfaceStep()), which come from the surfaces that the
 * alignment has made of both clouds.
 *
 * Where that finds nothing, as where points have no surface, and outside of KSSICP, it
 * is PCL's estimation from points.
 */
template <typename PointSource, typename PointTarget, typename Scalar>
class SurfaceEstimation
: public registration::TransformationEstimationSVD<PointSource, PointTarget, Scalar> {
  using Base =
      registration::TransformationEstimationSVD<PointSource, PointTarget, Scalar>;

  /** Steps whose contraction is averaged: chance makes single ones longer or shorter.
   */
  static constexpr std::size_t late_steps = 4;

  /** Beyond, steps hardly end. */
  static constexpr double strongest_contraction = 0.8;

public:
  using typename Base::Matrix4;

  /** \brief Begin a run of ICP.
   * \param[in] scorer knows the surfaces
   * \param[in] source the points that take part, as they are
   * \param[in] target_size number of points of the target
   * \param[in] pose where the run starts
   * \param[in] settings of the steps; the scale's bounds are those of the whole run
   * \param[in] goes_on whether it goes on from where the run before has been left
   */
  void
  start(const PoseScorer& scorer,
        const typename PointCloud<PointSource>::ConstPtr& source,
        std::size_t target_size,
        const Eigen::Matrix4d& pose,
        const SurfaceStepSettings& settings,
        bool goes_on = false)
  {
    scorer_ = &scorer;
    const double contraction = settings_.contraction;
    settings_ = settings;
    if (source_ != source) {
      source_ = source;
      Points normals(3, source->size());
      scorer.sourceNormals(placesOf(*source), normals);
      source_normals_ = normals.template cast<double>();
    }
    target_normals_.resize(3, target_size);
    is_known_.resize(target_size, false);
    linear_ = pose.topLeftCorner<3, 3>();
    last_ = {};
    if (goes_on)
      settings_.contraction = contraction;
    else
      moves_.clear();
  }

  /** \brief Forget the clouds. */
  void
  finish()
  {
    scorer_ = nullptr;
    source_.reset();
    source_normals_.resize(3, 0);
    target_normals_.resize(3, 0);
    is_known_.clear();
    moves_.clear();
  }

  /** \brief The last step. */
  const SurfaceStep&
  last() const
  {
    return last_;
  }

  /** \brief How precise the pose of the last step is.
   * \param[in] center of the source where it has been placed
   */
  SurfacePrecision
  precision(const Eigen::Vector3d& center) const
  {
    return last_.is_found ? surfacePrecision(pairs_, settings_, center)
                          : SurfacePrecision();
  }

  using Base::estimateRigidTransformation;

  void
  estimateRigidTransformation(const PointCloud<PointSource>& source,
                              const PointCloud<PointTarget>& target,
                              const Correspondences& correspondences,
                              Matrix4& transformation) const override
  {
    if (scorer_) {
      SurfaceStepSettings left = settings_;
      if (left.smallest_scale < left.largest_scale) {
        const double scale = std::cbrt(linear_.determinant());
        left.smallest_scale /= scale;
        left.largest_scale /= scale;
      }
      pairs_ = pairsOf(source, target, correspondences);
      last_ = surfaceStep(pairs_, left);
      moves_.push_back(last_.squared_errors_moved);
      settings_.contraction = contraction();
      if (last_.is_found) {
        transformation = last_.transformation.template cast<Scalar>();
        linear_ = last_.transformation.template topLeftCorner<3, 3>() * linear_;
        return;
      }
    }
    Base::estimateRigidTransformation(source, target, correspondences, transformation);
    linear_ =
        transformation.template topLeftCorner<3, 3>().template cast<double>() * linear_;
  }

private:
  /** By how much steps have become shorter from one to the next, of late. */
  double
  contraction() const
  {
    const std::size_t steps = std::min(moves_.size() - 1, late_steps);
    if (steps == 0 || !(moves_.back() > 0.0))
      return 0.0;
    const double all = moves_.back() / moves_[moves_.size() - 1 - steps];
    return std::min(strongest_contraction, std::pow(all, 0.5 / steps));
  }

  template <typename PointT>
  static Eigen::Matrix3Xd
  placesOf(const PointCloud<PointT>& cloud)
  {
    Eigen::Matrix3Xd places(3, cloud.size());
    for (std::size_t i = 0; i < cloud.size(); ++i)
      places.col(i) = cloud[i].getVector3fMap().template cast<double>();
    return places;
  }

  SurfacePairs
  pairsOf(const PointCloud<PointSource>& source,
          const PointCloud<PointTarget>& target,
          const Correspondences& correspondences) const
  {
    lookUp(target, correspondences);
    const Eigen::Matrix3d rotation = linear_ / std::cbrt(linear_.determinant());
    const auto size = static_cast<Eigen::Index>(correspondences.size());
    SurfacePairs pairs{Eigen::Matrix3Xd(3, size), Eigen::Matrix3Xd(3, size),
                       Eigen::Matrix3Xd(3, size), Eigen::Matrix3Xd(3, size)};
    for (Eigen::Index i = 0; i < size; ++i) {
      const index_t query = correspondences[i].index_query;
      const index_t match = correspondences[i].index_match;
      pairs.source.col(i) = source[query].getVector3fMap().template cast<double>();
      pairs.target.col(i) = target[match].getVector3fMap().template cast<double>();
      pairs.source_normals.col(i) = rotation * source_normals_.col(query);
      pairs.target_normals.col(i) = target_normals_.col(match).template cast<double>();
    }
    return pairs;
  }

  /** Learn the normals of the matched points of the target. */
  void
  lookUp(const PointCloud<PointTarget>& target,
         const Correspondences& correspondences) const
  {
    std::vector<index_t> unknown;
    for (const Correspondence& pair : correspondences)
      if (!is_known_[pair.index_match]) {
        is_known_[pair.index_match] = true;
        unknown.push_back(pair.index_match);
      }
    Eigen::Matrix3Xd places(3, unknown.size());
    for (std::size_t i = 0; i < unknown.size(); ++i)
      places.col(i) = target[unknown[i]].getVector3fMap().template cast<double>();
    Points normals(3, unknown.size());
    scorer_->targetNormals(places, normals);
    for (std::size_t i = 0; i < unknown.size(); ++i)
      target_normals_.col(unknown[i]) = normals.col(i);
  }

  const PoseScorer* scorer_ = nullptr;
  mutable SurfaceStepSettings settings_;
  typename PointCloud<PointSource>::ConstPtr source_; ///< of the normals
  Eigen::Matrix3Xd source_normals_{3, 0};
  mutable Points target_normals_;
  mutable std::vector<bool> is_known_;
  mutable Eigen::Matrix3d linear_ = Eigen::Matrix3d::Identity();
  mutable SurfacePairs pairs_;
  mutable SurfaceStep last_;
  mutable std::vector<double> moves_; ///< squared, of all steps of the run
};

} // namespace kss
} // namespace pcl
