/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/default_convergence_criteria.h>
#include <pcl/registration/kss/detail/stopping.h>

namespace pcl {
namespace kss {

/** \brief The final ICP can cost a pose the lead that it had among the simplified
 * clouds: then the next one gets its chance, so often at most. */
constexpr int most_final_icps = 3;

/** \brief Correspondences of the final ICP are no longer than so many spacings. */
constexpr double final_icp_reach = 4.0;

/** \brief The share of the score that a pose may lose to the final ICP: what chance
 * causes. */
constexpr double final_icp_loss = 0.01;

/** \brief Thrown through ICP where its transformation is none that points can follow:
 * PCL asserts that they are finite. */
struct NoPose {};

/** \brief When the final ICP has converged: PCL's criteria, free of units and fit for a
 * second run.
 *
 * PCL's compare the first iteration of a run with the last one of the run before, and
 * end by an absolute error. Here a run starts afresh, and the absolute bound is the
 * rounding error of the coordinates: clouds that fit exactly have no error left whose
 * relative change could tell.
 */
template <typename Scalar>
class FinalICPCriteria : public registration::DefaultConvergenceCriteria<Scalar> {
  using Base = registration::DefaultConvergenceCriteria<Scalar>;

public:
  using Base::Base;

  /** \brief Set the mean squared error at which nothing is left to gain. */
  void
  setRoundingError(double mean_squared_error)
  {
    rounding_error_ = mean_squared_error;
  }

  bool
  hasConverged() override
  {
    throwIfStopped();
    if (this->iterations_ <= 1)
      this->correspondences_prev_mse_ = std::numeric_limits<double>::max();
    if (Base::hasConverged())
      return true;
    if (this->convergence_state_ == Base::CONVERGENCE_CRITERIA_NOT_CONVERGED &&
        this->correspondences_cur_mse_ <= rounding_error_)
      this->convergence_state_ = Base::CONVERGENCE_CRITERIA_ABS_MSE;
    return this->convergence_state_ == Base::CONVERGENCE_CRITERIA_ABS_MSE;
  }

private:
  double rounding_error_ = 0.0;
};

} // namespace kss
} // namespace pcl
