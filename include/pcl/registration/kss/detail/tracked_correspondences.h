/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/correspondence_estimation.h>
#include <pcl/registration/kss/detail/packed_search.h>
#include <pcl/registration/kss/detail/stopping.h>
#include <pcl/registration/kss/detail/tracked_point.h>

#include <algorithm>
#include <limits>
#include <vector>

namespace pcl {
namespace kss {

/** \brief PCL's nearest point correspondences, without asking the tree for what is
 * known from the iteration before (\ref TrackedPoint). Nor is the tree built again
 * where it already holds the target.
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
    const auto* const packed =
        dynamic_cast<const PackedSearch<PointTarget>*>(this->tree_.get());
    const PackedTree* const tree =
        packed && packed->isOfSpace() ? &packed->packedTree() : nullptr;
    const double most = max_distance * max_distance;
    const auto limit =
        static_cast<float>(std::min<double>(looked_beyond * max_distance, infinite));
    correspondences.clear();
    correspondences.reserve(found_.size());
    for (std::size_t i = 0; i < found_.size(); ++i) {
      if (i % 4096 == 0)
        throwIfStopped();
      const index_t query = (*this->indices_)[i];
      const PointSource& point = (*this->input_)[query];
      const Eigen::Vector3f place = point.getVector3fMap();
      const float squared = found_[i].move(
          place, limit,
          [&](index_t target) {
            return ((*this->target_)[target].getVector3fMap() - place).squaredNorm();
          },
          [&](float squared_limit) {
            return tree ? tree->nearest(place.data(), squared_limit) : searched(point);
          });
      if (found_[i].nearest() >= 0 && squared <= most)
        correspondences.emplace_back(query, found_[i].nearest(), squared);
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
  static constexpr float infinite = std::numeric_limits<float>::infinity();

  NearestTwo
  searched(const PointSource& point)
  {
    NearestTwo two;
    const int number = this->tree_->nearestKSearchT(point, 2, nearest_, squared_);
    if (number > 0) {
      two.nearest = nearest_[0];
      two.squared = squared_[0];
    }
    if (number > 1) {
      two.second = nearest_[1];
      two.second_squared = squared_[1];
    }
    return two;
  }

  std::vector<TrackedPoint> found_;
  typename Base::PointCloudTargetConstPtr tracked_target_;
  Indices nearest_;
  std::vector<float> squared_;
};

} // namespace kss
} // namespace pcl
