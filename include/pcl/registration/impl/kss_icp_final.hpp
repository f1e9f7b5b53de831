/*
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * The final ICP, by PCL's: what kss::FinalStage runs.
 */

#pragma once

#include <pcl/registration/kss/detail/cloud_conversion.h>
#include <pcl/registration/kss/detail/final_icp.h>
#include <pcl/registration/kss/detail/final_stage.h>
#include <pcl/registration/kss/detail/similarity.h>
#include <pcl/registration/kss/detail/surface_estimation.h>
#include <pcl/registration/kss_icp.h>

#include <algorithm>

namespace pcl {

/** \brief Where a run of PCL's ICP ended. */
template <typename PointSource, typename PointTarget, typename Scalar>
struct KSSICP<PointSource, PointTarget, Scalar>::Run : kss::FinalRun {
  Matrix4 last_increment = Matrix4::Identity();
  Matrix4 previous_increment = Matrix4::Identity();
  Correspondences correspondences;

  PCL_MAKE_ALIGNED_OPERATOR_NEW
};

/** \brief IterativeClosestPoint, which works in the members of a KSSICP. */
template <typename PointSource, typename PointTarget, typename Scalar>
class PCL_KSS_ICP_NO_EXPORT KSSICP<PointSource, PointTarget, Scalar>::FinalICP
: public kss::FinalICP {
public:
  /** \param[in,out] icp has both clouds, and gets the transformations
   * \param[in] scorer knows their surfaces
   * \param[in] used points of the source that take part, sorted in space
   * \param[in] centroid of the source
   * \param[in] squared_rounding_error of the distance of two points
   */
  FinalICP(KSSICP& icp,
           const kss::PoseScorer& scorer,
           const Indices& used,
           const Eigen::Vector3d& centroid,
           double squared_rounding_error)
  : icp_(icp)
  , scorer_(scorer)
  , all_(kss::pointsAt(*icp.input_, used))
  , few_(kss::pointsAt(*icp.input_, kss::spread(used, kss::points_of_first_steps)))
  , centroid_(centroid)
  , surfaces_(dynamic_cast<kss::SurfaceEstimation<PointSource, PointTarget, Scalar>*>(
        icp.transformation_estimation_.get()))
  , criteria_(
        dynamic_cast<kss::FinalICPCriteria<Scalar>*>(icp.convergence_criteria_.get()))
  {
    if (criteria_)
      criteria_->setRoundingError(squared_rounding_error);
  }

  // whatever ends it, a callback's exception too, no cloud is kept
  ~FinalICP() override
  {
    if (surfaces_)
      surfaces_->steps().forgetClouds();
    if (criteria_)
      criteria_->follow({}, {});
  }

  FinalICP(const FinalICP&) = delete;
  FinalICP&
  operator=(const FinalICP&) = delete;

  bool
  iterate(const kss::FinalStep& step,
          const kss::FinalStepSettings& settings,
          kss::StoredPose& pose,
          int& iterations) override
  {
    // ICP reads input_, all of it; it gets those points for so long
    struct Restore {
      KSSICP& icp;
      PointCloudSourceConstPtr input;
      double reach;
      int iterations;
      ~Restore()
      {
        icp.input_ = input;
        icp.corr_dist_threshold_ = reach;
        icp.max_iterations_ = iterations;
      }
    } restore{icp_, icp_.input_, icp_.corr_dist_threshold_, icp_.max_iterations_};
    icp_.input_ = step.has_all_points ? all_ : few_;
    icp_.max_iterations_ = step.iterations;
    icp_.corr_dist_threshold_ = std::min(icp_.corr_dist_threshold_, settings.reach);
    if (surfaces_)
      start(pose, settings);
    if (criteria_)
      criteria_->follow(surfaces_ ? &surfaces_->steps().last() : nullptr,
                        settings.made);
    PointCloudSource unused;
    bool is_pose = true;
    try {
      icp_.Base::computeTransformation(unused, Matrix4(pose.template cast<Scalar>()));
    }
    catch (const kss::NoPose&) {
      is_pose = false;
    }
    iterations = icp_.nr_iterations_;
    if (!is_pose)
      return false;
    pose = icp_.final_transformation_.template cast<double>();
    return kss::isSimilarity(pose);
  }

  std::shared_ptr<kss::FinalRun>
  lastRun(bool is_pose) override
  {
    const auto run = std::make_shared<Run>();
    run->transformation = icp_.final_transformation_.template cast<double>();
    run->converged = icp_.converged_;
    run->has_too_few_pairs = icp_.correspondences_->size() <
                             static_cast<std::size_t>(icp_.min_number_correspondences_);
    if (!is_pose)
      return run;
    run->last_increment = icp_.transformation_;
    run->previous_increment = icp_.previous_transformation_;
    run->correspondences = *icp_.correspondences_;
    if (surfaces_)
      run->precision = surfaces_->steps().precision(
          (run->transformation * centroid_.homogeneous()).template head<3>());
    return run;
  }

private:
  void
  start(const kss::StoredPose& pose, const kss::FinalStepSettings& settings)
  {
    if (source_of_surfaces_ != icp_.input_) {
      source_of_surfaces_ = icp_.input_;
      Eigen::Matrix3Xd places(3, icp_.input_->size());
      for (std::size_t i = 0; i < icp_.input_->size(); ++i)
        places.col(i) = (*icp_.input_)[i].getVector3fMap().template cast<double>();
      surfaces_->steps().setClouds(scorer_, places, icp_.target_->size());
    }
    surfaces_->steps().start(pose, settings.surfaces, settings.goes_on);
  }

  KSSICP& icp_;
  const kss::PoseScorer& scorer_;
  PointCloudSourceConstPtr all_, few_;
  PointCloudSourceConstPtr source_of_surfaces_;
  Eigen::Vector3d centroid_;
  kss::SurfaceEstimation<PointSource, PointTarget, Scalar>* surfaces_; ///< may be null
  kss::FinalICPCriteria<Scalar>* criteria_;                            ///< may be null
};

template <typename PointSource, typename PointTarget, typename Scalar>
void
KSSICP<PointSource, PointTarget, Scalar>::accept(const kss::FinalContender& contender,
                                                 const Indices& source_indices)
{
  precision_ = {};
  correspondences_->clear();
  final_transformation_ = contender.alternative.transformation.template cast<Scalar>();
  if (!contender.run)
    return;
  const Run& run = static_cast<const Run&>(*contender.run);
  final_transformation_ = run.transformation.template cast<Scalar>();
  transformation_ = run.last_increment;
  previous_transformation_ = run.previous_increment;
  nr_iterations_ = run.iterations;
  precision_ = run.precision;
  *correspondences_ = run.correspondences;
  for (Correspondence& correspondence : *correspondences_)
    correspondence.index_query = source_indices[correspondence.index_query];
}

template <typename PointSource, typename PointTarget, typename Scalar>
void
KSSICP<PointSource, PointTarget, Scalar>::acceptCopies(const kss::Alternatives& copies)
{
  const auto run = std::make_shared<Run>();
  run->transformation = copies.front().transformation;
  run->iterations = 1;
  run->converged = true;
  accept({copies.front(), run}, {});
  alternatives_ = copies;
  failure_ = kss::failureOf(settings_, alternatives_, run.get(), "", {});
  converged_ = failure_.cause == kss::FailureCause::NONE;
}

} // namespace pcl
