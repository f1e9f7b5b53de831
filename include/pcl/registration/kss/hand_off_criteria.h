/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/default_convergence_criteria.h>
#include <pcl/registration/kss/stopping.h>

namespace pcl {
namespace kss {

/** \brief When the final ICP has converged: PCL's criteria, free of units and fit for a
 * second run.
 *
 * PCL's compare the first iteration of a run with the last one of the run before, and
 * end by an absolute error. Here a run starts afresh, and the absolute bound is the
 * rounding error of the coordinates: clouds that fit exactly have no error left whose
 * relative change could tell.
 */
template <typename Scalar>
class HandOffCriteria : public registration::DefaultConvergenceCriteria<Scalar> {
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
