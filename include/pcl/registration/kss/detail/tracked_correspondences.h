/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/correspondence_estimation.h>
#include <pcl/registration/kss/detail/stopping.h>

#include <cmath>
#include <vector>

namespace pcl {
namespace kss {

/** \brief PCL's nearest point correspondences, without asking the tree for what is
 * known from the iteration before.
 *
 * The nearest target point of a source point stays the nearest as long as the point has
 * moved by less than half the difference to the second nearest: late iterations of ICP
 * hardly need the tree. Nor is the tree built again where it already holds the target.
 */
template <typename PointSource, typename PointTarget, typename Scalar>
class TrackedCorrespondences
: public registration::CorrespondenceEstimation<PointSource, PointTarget, Scalar> {
  using Base = registration::CorrespondenceEstimation<PointSource, PointTarget, Scalar>;
  using Correspondences = pcl::Correspondences;

public:
  TrackedCorrespondences() { this->corr_name_ = "TrackedCorrespondences"; }

  void
  determineCorrespondences(
      Correspondences& correspondences,
      double max_distance = std::numeric_limits<double>::max()) override
  {
    // another point representation may mean other distances than those of space
    if (this->point_representation_ || this->target_indices_) {
      Base::determineCorrespondences(correspondences, max_distance);
      return;
    }
    if (this->tree_ && this->tree_->getInputCloud() == this->target_)
      this->target_cloud_updated_ = false;
    else
      tracked_target_.reset();
    if (!this->initCompute())
      return;
    if (tracked_target_ != this->target_ || found_.size() != this->indices_->size()) {
      found_.assign(this->indices_->size(), {});
      tracked_target_ = this->target_;
    }
    const double most = max_distance * max_distance;
    correspondences.clear();
    correspondences.reserve(found_.size());
    for (std::size_t i = 0; i < found_.size(); ++i) {
      if (i % 4096 == 0)
        throwIfStopped();
      const index_t query = (*this->indices_)[i];
      const float squared = update(found_[i], (*this->input_)[query]);
      if (squared <= most)
        correspondences.emplace_back(query, found_[i].nearest, squared);
    }
    this->deinitCompute();
  }

  /** \brief Forget what is known: the tree may have been built anew. */
  void
  reset()
  {
    tracked_target_.reset();
  }

  typename registration::
      CorrespondenceEstimationBase<PointSource, PointTarget, Scalar>::Ptr
      clone() const override
  {
    return typename Base::Ptr(new TrackedCorrespondences(*this));
  }

private:
  /** \brief The target point nearest to a place, and how far from it that stays so. */
  struct Found {
    index_t nearest = -1;
    Eigen::Vector3f place;
    float squared_slack = 0.0f;
  };

  /** \brief Find the nearest point; its squared distance. */
  float
  update(Found& found, const PointSource& point)
  {
    const Eigen::Vector3f place = point.getVector3fMap();
    if (found.nearest >= 0 && (place - found.place).squaredNorm() < found.squared_slack)
      return ((*this->target_)[found.nearest].getVector3fMap() - place).squaredNorm();
    if (this->tree_->nearestKSearchT(point, 2, nearest_, squared_) < 1)
      return std::numeric_limits<float>::infinity();
    const float second =
        nearest_.size() > 1 ? squared_[1] : std::numeric_limits<float>::max();
    // rounding aside
    const float slack = 0.4999f * (std::sqrt(second) - std::sqrt(squared_[0]));
    found = {nearest_[0], place, slack * slack};
    return squared_[0];
  }

  std::vector<Found> found_;
  typename Base::PointCloudTargetConstPtr tracked_target_;
  Indices nearest_;
  std::vector<float> squared_;
};

} // namespace kss
} // namespace pcl
