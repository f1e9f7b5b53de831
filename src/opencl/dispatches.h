/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/detail/stopping.h>

#include <algorithm>
#include <chrono>
#include <cstddef>

namespace pcl {
namespace kss {

/** \brief How many items of some work fit one dispatch of a device. */
struct DispatchLimits {
  /** \brief What the buffers of a dispatch take together at most: a single one of them
   * is no larger than the device allows, and a CPU has to share its memory. */
  std::size_t bytes;
  /** \brief Items that a device does at once: fewer take no less time. */
  std::size_t at_once;
};

/** \brief One kind of work, done in dispatches that fit the device's memory and take
 * about a tenth of a second each, as far as an item can: in between it can be stopped,
 * and no watchdog of a display's driver takes it for hung.
 *
 * Items do not depend on each other, so that the results do not depend on the
 * dispatches.
 */
class Dispatches {
public:
  /** \brief Do the work: dispatch(begin, end) for all of it, piece by piece.
   * \param[in] limits of the device
   * \param[in] size items
   * \param[in] bytes that an item takes on the device
   * \param[in] operations of an item, of any kind, but always the same
   * \param[in] dispatch what waits for the end of its work
   * \throws Stopped between two dispatches
   */
  template <typename Dispatch>
  void
  run(const DispatchLimits& limits,
      std::size_t size,
      std::size_t bytes,
      double operations,
      const Dispatch& dispatch)
  {
    using Clock = std::chrono::steady_clock;
    const std::size_t fitting = std::max<std::size_t>(1, limits.bytes / bytes);
    for (std::size_t begin = 0; begin < size;) {
      throwIfStopped();
      const double in_time = std::min(1e15, seconds * speed_ / operations);
      const std::size_t end =
          begin +
          std::min({size - begin, fitting,
                    std::max(limits.at_once, static_cast<std::size_t>(in_time))});
      const auto start = Clock::now();
      dispatch(begin, end);
      const std::chrono::duration<double> took = Clock::now() - start;
      speed_ =
          operations * static_cast<double>(end - begin) / std::max(took.count(), 1e-6);
      begin = end;
    }
  }

private:
  static constexpr double seconds = 0.1; ///< that a dispatch takes

  /** Operations per second, of the last dispatch; before the first one, few. */
  double speed_ = 3e8;
};

} // namespace kss
} // namespace pcl
