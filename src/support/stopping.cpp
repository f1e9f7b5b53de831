/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include <pcl/registration/kss/detail/stopping.h>

#include <sstream>

namespace pcl {
namespace kss {
namespace {

thread_local const StopSignal* heeded = nullptr;

} // namespace

void
StopSignal::restart(double seconds)
{
  using Seconds = std::chrono::duration<double>;
  cancelled_ = false;
  seconds_ = seconds;
  const Clock::time_point now = Clock::now(), never = Clock::time_point::max();
  end_ = seconds > 0.0 && Seconds(seconds) < never - now
             ? now + std::chrono::duration_cast<Clock::duration>(Seconds(seconds))
             : never;
}

bool
StopSignal::isSet() const
{
  return cancelled_.load(std::memory_order_relaxed) ||
         (end_ != Clock::time_point::max() && Clock::now() >= end_);
}

void
StopSignal::throwIfSet() const
{
  if (!isSet())
    return;
  if (cancelled_)
    throw Stopped("The registration was cancelled");
  std::ostringstream message;
  message << "The time limit of " << seconds_ << " s has passed";
  throw Stopped(message.str());
}

const StopSignal*
heededSignal()
{
  return heeded;
}

void
throwIfStopped()
{
  if (heeded)
    heeded->throwIfSet();
}

HeedingSignal::HeedingSignal(const StopSignal* signal)
: before_(heeded)
{
  heeded = signal;
}

HeedingSignal::~HeedingSignal()
{
  heeded = before_;
}

} // namespace kss
} // namespace pcl
