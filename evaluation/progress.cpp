/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "progress.h"

#include <algorithm>
#include <cmath>
#include <iostream>

namespace evaluation {
namespace {

std::string
effortKey(const Run& run)
{
  return run.method.name + '/' + std::to_string(run.condition.points);
}

std::string
durationOf(double seconds)
{
  return seconds < 100.0 ? std::to_string(std::lround(seconds)) + " s"
                         : std::to_string(std::lround(seconds / 60.0)) + " min";
}

} // namespace

Progress::Progress(const std::vector<Run>& runs, unsigned int jobs)
: planned_(runs.size())
, jobs_(jobs)
{
  for (const auto& run : runs)
    ++by_method_[effortKey(run)].planned;
  if (tool::ProgressBar::hasAudience())
    bar_.emplace();
}

void
Progress::add(const Run& run, double seconds)
{
  auto& effort = by_method_[effortKey(run)];
  ++effort.done;
  ++done_;
  effort.seconds += seconds;
  seconds_ += seconds;
  const std::string left = durationOf(secondsLeft()) + " left";
  if (bar_) {
    bar_->show(left, static_cast<double>(done_) / static_cast<double>(planned_));
  }
  else if (10 * done_ / planned_ > tenths_told_) {
    tenths_told_ = 10 * done_ / planned_;
    std::cerr << done_ << " of " << planned_ << " registrations done, " << left
              << std::endl;
  }
}

double
Progress::secondsLeft() const
{
  const double mean = seconds_ / static_cast<double>(done_);
  double left = 0.0;
  for (const auto& [key, effort] : by_method_)
    left += static_cast<double>(effort.planned - effort.done) *
            (effort.done ? effort.seconds / static_cast<double>(effort.done) : mean);
  return left / jobs_;
}

} // namespace evaluation
