/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/default_convergence_criteria.h>
#include <pcl/registration/kss/detail/stopping.h>
#include <pcl/registration/kss/detail/surface_step.h>

#include <cstddef>
#include <functional>
#include <limits>

namespace pcl {
namespace kss {

/** \brief Poses that may be right go through the final ICP, the likeliest first: those
 * whose overlap's score is at least this share of the best one. */
constexpr double hope = 0.75;

/** \brief Where none of them has odds that good, as logarithm, no more are tried than
 * are likelier already: the clouds do not fit. */
constexpr double hopeless = -2.0;

/** \brief And, unless the odds of one of them are ten to one, so many of the others. */
constexpr double doubtless = 2.3; // the logarithm
constexpr int most_final_icps = 3;

/** \brief How far the logarithm of the scale may be from that of scale 1 for both to
 * explain the clouds: parts of known size come out up to a tenth off. */
constexpr double nearly_scale_one = 0.12;

/** \brief Correspondences of the final ICP are no longer than so many spacings. */
constexpr double final_icp_reach = 4.0;

/** \brief With so many points of the source most of the way is made: what is left is
 * their standard error. */
constexpr std::size_t points_of_first_steps = 2000;

/** \brief So many steps with few points, and with all of them before a pose is compared
 * with its rival: a right one takes a dozen, a wrong one, with nothing to settle on,
 * hundreds. */
constexpr int most_first_steps = 40;

/** \brief Odds of a hundred to one, as logarithm, between two poses: what the worse one
 * may still gain changes the confidence in the better one by a hundredth at most. */
constexpr double no_rival = 4.6;

/** \brief A pose that its rival is ahead of by more than chance when it has made those
 * steps with all points is left: right poses are at rest by then. */
constexpr double left_behind = 0.0;

/** \brief Steps of a run, about: what progress goes by. */
constexpr double usual_steps = 10.0;

/** \brief Poses whose scores are that near, as a ratio, may be equal: of two samplings
 * of a symmetric shape. */
constexpr double same_score = 0.97;

/** \brief The share of the score that a pose may lose to the final ICP: what chance
 * causes. */
constexpr double final_icp_loss = 0.01;

/** \brief Steps smaller than this share of the pose's standard errors, root mean square
 * over its directions, are at rest. */
constexpr double at_rest = 0.1;

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

  /** \brief Take the steps of an estimation for what says whether clouds are at rest.
   * \param[in] step the last one, whenever it is asked for; null: PCL's criteria do
   */
  void
  follow(const SurfaceStep* step)
  {
    step_ = step;
  }

  /** \brief Tell somebody of every step.
   * \param[in] told of the number of steps of the run so far; may be empty
   */
  void
  tell(const std::function<void(int)>& told)
  {
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
    if (this->convergence_state_ == Base::CONVERGENCE_CRITERIA_NOT_CONVERGED &&
        this->correspondences_cur_mse_ <= rounding_error_)
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
