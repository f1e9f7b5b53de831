/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "progress_bar.h"

#include <algorithm>
#include <cmath>
#include <iostream>

#include <unistd.h>

namespace tool {

bool
ProgressBar::hasAudience()
{
  return isatty(STDERR_FILENO) == 1;
}

ProgressBar::~ProgressBar()
{
  if (!shown_.empty())
    std::cerr << '\r' << std::string(shown_.size(), ' ') << '\r' << std::flush;
}

void
ProgressBar::show(const std::string& stage, double done)
{
  constexpr std::size_t WIDTH = 30, NAME = 16;
  const auto filled =
      static_cast<std::size_t>(std::lround(WIDTH * std::min(std::max(done, 0.0), 1.0)));
  std::string line = stage.substr(0, NAME);
  line.resize(NAME, ' ');
  line += '[' + std::string(filled, '=') + std::string(WIDTH - filled, ' ') + ']';
  if (line == shown_)
    return; // many calls do not move it
  shown_ = line;
  std::cerr << '\r' << shown_ << std::flush;
}

} // namespace tool
