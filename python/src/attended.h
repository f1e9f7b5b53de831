/*
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * Work in C++ that Python waits for.
 */

#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

namespace pcl_kss_icp {

/** \brief Work on a thread of its own, while the one that called from Python looks
 * after signals and progress: neither waits for the end of a long stage, and Python's
 * own code runs on the thread that it belongs to.
 */
class Attended {
public:
  /** \param[in] progress of Python's, called with a stage and the share of it that is
   * done; None: nobody is told
   * \param[in] cancelled set by anybody who wants the work to end
   * \param[in] cancel has the work end soon; asked for again and again until it has,
   * since work that has not begun yet would forget it
   */
  Attended(pybind11::object progress,
           const std::atomic<bool>& cancelled,
           std::function<void()> cancel);

  /** \brief Run, the GIL being released as long as nothing of Python's is called.
   *
   * What the progress callback or a signal's handler raises, as KeyboardInterrupt is,
   * ends the work and is thrown.
   */
  void
  run(const std::function<void()>& work);

  /** \brief Told by the work how far it is; returns when Python has been told. */
  void
  told(const std::string& stage, double done);

private:
  using Told = std::pair<std::string, double>;

  /** \brief Let Python see signals, and how far the work is. */
  void
  attend(const std::optional<Told>& told) const;

  pybind11::object progress_;
  const std::atomic<bool>& cancelled_;
  std::function<void()> cancel_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<Told> told_; ///< and not yet passed on
  bool is_done_ = false;
};

} // namespace pcl_kss_icp
