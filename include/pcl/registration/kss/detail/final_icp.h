/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/default_convergence_criteria.h>
#include <pcl/registration/kss/detail/final_stage.h>
#include <pcl/registration/kss/detail/stopping.h>
#include <pcl/registration/kss/detail/surface_step.h>

#include <functional>
#include <limits>

namespace pcl {
namespace kss {

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

  /** \brief Follow a run.
   * \param[in] step the last one, whenever it is asked for, which says whether clouds
   * are at rest; null: PCL's criteria do
   * \param[in] told of the number of steps so far; may be empty
   */
  void
  follow(const SurfaceStep* step, const std::function<void(int)>& told)
  {
    step_ = step;
    told_ = told;
  }

  bool
  hasConverged() override
  {
    if (told_)
      told_(this->iterations_);
    throwIfStopped();
    if (this->iterations_ <= 1)
      this->correspondences_prev_mse_ = std::numeric_limits<double>::max();
    if (Base::hasConverged())
      return true;
    // at the limit, clouds that moved by less than a standard error are at rest, too
    const bool is_over = this->convergence_state_ ==
                         Base::CONVERGENCE_CRITERIA_FAILURE_AFTER_MAX_ITERATIONS;
    const double most = is_over ? 1.0 : at_rest * at_rest;
    if (step_ && step_->is_found && step_->squared_errors_moved < most) {
      this->convergence_state_ = Base::CONVERGENCE_CRITERIA_TRANSFORM;
      return true;
    }
    // and so are those that had met before
    if (this->correspondences_cur_mse_ <= rounding_error_)
      this->convergence_state_ = Base::CONVERGENCE_CRITERIA_ABS_MSE;
    return this->convergence_state_ == Base::CONVERGENCE_CRITERIA_ABS_MSE;
  }

private:
  double rounding_error_ = 0.0;
  const SurfaceStep* step_ = nullptr;
  std::function<void(int)> told_;
};

} // namespace kss
} // namespace pcl
