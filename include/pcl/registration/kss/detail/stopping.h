/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/export.h>

#include <atomic>
#include <chrono>
#include <stdexcept>

namespace pcl {
namespace kss {

/** \brief Thrown through a stage that has been told to stop, by throwIfStopped(). */
class PCL_KSS_ICP_EXPORT Stopped : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

/** \brief Tells work that it is to stop, at a time or at once. */
class PCL_KSS_ICP_EXPORT StopSignal {
public:
  /** \brief Take back what was said before, and stop at a time.
   * \param[in] seconds from now; 0: at no time
   */
  void
  restart(double seconds);

  /** \brief Stop at once; from any thread, or from a signal's handler. */
  void
  cancel() noexcept
  {
    cancelled_.store(true, std::memory_order_relaxed);
  }

  /** \brief Whether to stop. */
  bool
  isSet() const;

  /** \brief Throw Stopped if isSet(). */
  void
  throwIfSet() const;

private:
  using Clock = std::chrono::steady_clock;

  std::atomic<bool> cancelled_{false};
  double seconds_ = 0.0;
  Clock::time_point end_ = Clock::time_point::max();
};

/** \brief The signal that the work of this thread heeds; null: none. */
PCL_KSS_ICP_EXPORT const StopSignal*
heededSignal();

/** \brief Throws Stopped where the signal that this thread heeds is set. Every stage
 * asks often enough to end within two tenths of a second.
 */
PCL_KSS_ICP_EXPORT void
throwIfStopped();

/** \brief Has the work of this thread, and that of the threads that share it
 * (inParallel()), heed a signal as long as it lives.
 */
class PCL_KSS_ICP_EXPORT HeedingSignal {
public:
  /** \param[in] signal kept by reference; null: none */
  explicit HeedingSignal(const StopSignal* signal);

  ~HeedingSignal();

  HeedingSignal(const HeedingSignal&) = delete;
  HeedingSignal&
  operator=(const HeedingSignal&) = delete;

private:
  const StopSignal* before_;
};

} // namespace kss
} // namespace pcl
