/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "run.h"

#include "../tools/command_line/progress_bar.h"

#include <map>
#include <optional>
#include <vector>

namespace evaluation {

/** \brief Tells on standard error how many runs are done and how much time is left: as
 * a bar, or, where nobody looks, as a line now and then.
 */
class Progress {
public:
  /** \param[in] runs all that there is to do
   * \param[in] jobs how many run at once
   */
  Progress(const std::vector<Run>& runs, unsigned int jobs);

  /** \brief One more is done. */
  void
  add(const Run& run, double seconds);

private:
  /** Seconds that are left, as long as each method takes in the mean. */
  double
  secondsLeft() const;

  struct Effort {
    std::size_t planned = 0, done = 0;
    double seconds = 0.0;
  };
  std::map<std::string, Effort> by_method_; ///< and number of points
  std::size_t planned_ = 0, done_ = 0, tenths_told_ = 0;
  double seconds_ = 0.0;
  unsigned int jobs_;
  std::optional<tool::ProgressBar> bar_;
};

} // namespace evaluation
