/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <cstddef>
#include <string>

namespace tool {

/** \brief A line on standard error that shows how far a stage of the work has come, as
 * wide as the terminal, and goes away in the end.
 */
class ProgressBar {
public:
  /** \brief Whether there is somebody to look at it. */
  static bool
  hasAudience();

  ~ProgressBar();

  /** \param[in] done the share of the stage that is done, in [0, 1]
   * \param[in] left how much longer it takes; may be empty
   */
  void
  show(const std::string& stage, double done, const std::string& left = "");

private:
  /** \brief Replace the line. */
  void
  write(const std::string& line);

  std::string shown_;
};

/** \brief What it shows: shorter than the terminal is wide. */
std::string
progressLine(const std::string& stage,
             double done,
             std::size_t columns,
             const std::string& left = "");

} // namespace tool
