/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "command_line/progress_bar.h"

#include <chrono>
#include <optional>
#include <string>

namespace tool {

/** \brief Tells people how far a stage has come, and how long the rest of it will take:
 * on a terminal at any time, otherwise in a line for each stage.
 */
class StageProgress {
public:
  /** \param[in] quiet whether to say nothing */
  explicit StageProgress(bool quiet);

  /** \param[in] done the share of the stage that is done, in [0, 1] */
  void
  show(const std::string& stage, double done);

  /** \brief All is done: the bar goes away. */
  void
  end();

private:
  using Clock = std::chrono::steady_clock;

  const bool quiet_;
  std::string stage_;
  Clock::time_point start_;
  double begun_at_ = 0.0; ///< what had been done before
  std::optional<ProgressBar> bar_;
};

} // namespace tool
