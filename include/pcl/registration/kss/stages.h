/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/settings.h>

#include <chrono>
#include <string>
#include <vector>

namespace pcl {
namespace kss {

/** \brief Wall time of one stage. */
struct StageSeconds {
  std::string stage; ///< its name
  double seconds;    ///< how long it took
};

/** \brief The stages of a registration, one after the other: tells who wants to know
 * how far each has come, and notes how long each took.
 */
class Stages {
public:
  /** \brief Forget all stages.
   * \param[in] progress is told of the next ones; may be empty
   */
  void
  restart(const ProgressCallback& progress)
  {
    progress_ = progress;
    seconds_.clear();
  }

  /** \brief Begin a stage. */
  void
  begin(const std::string& stage)
  {
    stage_ = stage;
    begin_ = Clock::now();
    progress(0.0);
  }

  /** \brief Tell how much of the stage is done, in [0, 1]. */
  void
  progress(double done) const
  {
    if (progress_)
      progress_(stage_, done);
  }

  /** \brief End the stage. */
  void
  end()
  {
    progress(1.0);
    seconds_.push_back(
        {stage_, std::chrono::duration<double>(Clock::now() - begin_).count()});
  }

  /** \brief The stages that have ended, in their order. */
  const std::vector<StageSeconds>&
  seconds() const
  {
    return seconds_;
  }

private:
  using Clock = std::chrono::steady_clock;

  ProgressCallback progress_;
  std::string stage_;
  Clock::time_point begin_;
  std::vector<StageSeconds> seconds_;
};

} // namespace kss
} // namespace pcl
