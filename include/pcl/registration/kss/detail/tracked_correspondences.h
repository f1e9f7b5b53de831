/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/correspondence_estimation.h>
#include <pcl/registration/kss/detail/packed_search.h>
#include <pcl/registration/kss/detail/stopping.h>

#include <algorithm>
#include <cmath>
#include <limits>
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
    const auto* const packed =
        dynamic_cast<const PackedSearch<PointTarget>*>(this->tree_.get());
    const PackedTree* const tree =
        packed && packed->isOfSpace() ? &packed->packedTree() : nullptr;
    const double most = max_distance * max_distance;
    limit_ =
        static_cast<float>(std::min<double>(looked_beyond * max_distance, infinite));
    correspondences.clear();
    correspondences.reserve(found_.size());
    for (std::size_t i = 0; i < found_.size(); ++i) {
      if (i % 4096 == 0)
        throwIfStopped();
      const index_t query = (*this->indices_)[i];
      const float squared = update(found_[i], (*this->input_)[query], tree);
      if (found_[i].nearest >= 0 && squared <= most)
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
  static constexpr float infinite = std::numeric_limits<float>::infinity();

  /** Points are looked for that much farther than correspondences reach: what finds
   * none then needs not look again as soon as it moves. */
  static constexpr double looked_beyond = 1.25;

  /** \brief The target points nearest to a place, and how far from it that stays so. */
  struct Found {
    bool is_known = false;
    index_t nearest = -1; ///< -1: none within the limit
    index_t second = -1;
    Eigen::Vector3f place;
    float squared_slack = 0.0f;
    float limit = 0.0f; ///< no point was looked for beyond
  };

  /** \brief Find the nearest point; its squared distance, infinite where there is none.
   * \param[in] tree of the target; null: any search
   */
  float
  update(Found& found, const PointSource& point, const PackedTree* tree)
  {
    const Eigen::Vector3f place = point.getVector3fMap();
    const auto squaredTo = [&](index_t target) {
      return ((*this->target_)[target].getVector3fMap() - place).squaredNorm();
    };
    if (found.is_known && limit_ <= found.limit &&
        (place - found.place).squaredNorm() < found.squared_slack)
      return found.nearest < 0 ? infinite : squaredTo(found.nearest);
    float squared_limit = limit_ * limit_;
    if (found.second >= 0) // the two of before, rounding aside
      squared_limit =
          std::min(squared_limit, 1.0001f * std::max(squaredTo(found.nearest),
                                                     squaredTo(found.second)));
    const NearestTwo two =
        tree ? tree->nearest(place.data(), squared_limit) : searched(point);
    const float nearest = std::sqrt(two.squared);
    const float second = std::min(std::sqrt(two.second_squared), limit_);
    // rounding aside
    const float slack = two.nearest >= 0
                            ? 0.4999f * (second - nearest)
                            : 0.999f * (1.0f - 1.0f / looked_beyond) * limit_;
    found = {true, two.nearest, two.second, place, slack * std::abs(slack), limit_};
    return two.squared;
  }

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

  std::vector<Found> found_;
  typename Base::PointCloudTargetConstPtr tracked_target_;
  Indices nearest_;
  std::vector<float> squared_;
  float limit_ = infinite; ///< how far points are looked for
};

} // namespace kss
} // namespace pcl
