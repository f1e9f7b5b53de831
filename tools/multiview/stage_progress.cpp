/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "stage_progress.h"

#include "command_line/quantities.h"

#include <iostream>

namespace tool {
namespace {

/** The rest of a stage is guessed when so much of it has been seen. */
constexpr double enough_seen = 0.02;

} // namespace

StageProgress::StageProgress(bool quiet)
: quiet_(quiet)
{
  if (!quiet && ProgressBar::hasAudience())
    bar_.emplace();
}

void
StageProgress::show(const std::string& stage, double done)
{
  if (quiet_)
    return;
  const bool is_new = stage != stage_;
  if (is_new) {
    stage_ = stage;
    start_ = Clock::now();
    begun_at_ = done;
  }
  if (!bar_) {
    if (is_new)
      std::cerr << stage << "...\n";
    return;
  }
  const std::chrono::duration<double> seconds = Clock::now() - start_;
  const double seen = done - begun_at_;
  const std::string left =
      seen > enough_seen && done < 1.0
          ? timeText(seconds.count() * (1.0 - done) / seen) + " left"
          : "";
  bar_->show(stage, done, left);
}

void
StageProgress::end()
{
  bar_.reset();
}

} // namespace tool
