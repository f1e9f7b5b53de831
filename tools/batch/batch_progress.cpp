/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "batch_progress.h"

#include "command_line/quantities.h"

#include <iomanip>
#include <iostream>
#include <sstream>

namespace tool {

BatchProgress::BatchProgress(std::size_t pairs, std::size_t before, bool quiet)
: pairs_(pairs)
, before_(before)
, quiet_(quiet)
{
  if (!quiet && ProgressBar::hasAudience())
    bar_.emplace();
}

void
BatchProgress::step()
{
  constexpr std::chrono::seconds NOW_AND_THEN(60);
  ++done_;
  if (quiet_)
    return;
  const std::size_t done = before_ + done_;
  const double left =
      seconds() / static_cast<double>(done_) * static_cast<double>(pairs_ - done);
  if (bar_)
    bar_->show("pairs", static_cast<double>(done) / static_cast<double>(pairs_),
               timeText(left) + " left");
  else if (Clock::now() - told_ >= NOW_AND_THEN) {
    told_ = Clock::now();
    std::cerr << done << " of " << pairs_ << " pairs; " << pace() << "; "
              << timeText(left) << " left\n";
  }
}

std::string
BatchProgress::pace() const
{
  std::ostringstream text;
  text << std::setprecision(3) << counted(done_, "pair") << " in " << seconds() << " s";
  if (done_ > 0)
    text << ", " << static_cast<double>(done_) / seconds() << " per second";
  return text.str();
}

double
BatchProgress::seconds() const
{
  return std::chrono::duration<double>(Clock::now() - start_).count();
}

} // namespace tool
