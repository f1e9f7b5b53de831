/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "command_line/progress_bar.h"

#include <chrono>
#include <cstddef>
#include <optional>
#include <string>

namespace tool {

/** \brief Tells people how many pairs are done, and how long the rest will take: on a
 * terminal at any time, otherwise in a line now and then.
 */
class BatchProgress {
public:
  /** \param[in] before how many had been done before this start
   * \param[in] quiet whether to say nothing
   */
  BatchProgress(std::size_t pairs, std::size_t before, bool quiet);

  /** \brief One more is done. */
  void
  step();

  /** \brief How many have been done since the start, and how fast. */
  std::string
  pace() const;

private:
  using Clock = std::chrono::steady_clock;

  double
  seconds() const;

  const std::size_t pairs_, before_;
  const bool quiet_;
  const Clock::time_point start_ = Clock::now();
  Clock::time_point told_ = start_;
  std::size_t done_ = 0;
  std::optional<ProgressBar> bar_;
};

} // namespace tool
