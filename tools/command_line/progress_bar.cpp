/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "progress_bar.h"

#include <algorithm>
#include <cmath>
#include <iostream>

#include <sys/ioctl.h>
#include <unistd.h>

namespace tool {
namespace {

/** The columns of the terminal as it is now: it may be resized at any time. */
std::size_t
columns()
{
  constexpr std::size_t USUAL = 80;
  winsize size{};
  return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col
                                                                         : USUAL;
}

} // namespace

bool
ProgressBar::hasAudience()
{
  return isatty(STDERR_FILENO) == 1;
}

ProgressBar::~ProgressBar()
{
  write("");
}

void
ProgressBar::show(const std::string& stage, double done, const std::string& left)
{
  write(progressLine(stage, done, columns(), left));
}

void
ProgressBar::write(const std::string& line)
{
  if (line == shown_)
    return; // many calls do not move it
  // what was longer is wiped out, but for what a narrower terminal has wrapped
  const std::size_t rest = std::min(shown_.size(), columns() - 1);
  const std::size_t blanks = rest > line.size() ? rest - line.size() : 0;
  std::cerr << '\r' << line << std::string(blanks, ' ')
            << (blanks > 0 ? '\r' + line : "") << std::flush;
  shown_ = line;
}

std::string
progressLine(const std::string& stage,
             double done,
             std::size_t columns,
             const std::string& left)
{
  constexpr std::size_t NAME = 18, PERCENT = 6, LEFT = 18, FRAME = 2, LONGEST = 100;
  const double share = std::min(std::max(done, 0.0), 1.0);
  // a terminal wraps a line that fills it
  const std::size_t width = std::min(std::max<std::size_t>(columns, 2) - 1, LONGEST);
  std::string percent = std::to_string(std::lround(100.0 * share)) + " %";
  percent.insert(0, PERCENT - std::min(PERCENT, percent.size()), ' ');
  std::string rest;
  if (!left.empty()) {
    rest = ", " + left;
    rest.resize(std::max(rest.size(), LEFT), ' '); // so that the bar keeps its length
  }
  std::string line = stage;
  line.resize(NAME, ' ');
  if (width > NAME + PERCENT + rest.size() + FRAME) {
    const std::size_t bar = width - NAME - PERCENT - rest.size() - FRAME;
    const auto filled = static_cast<std::size_t>(std::lround(bar * share));
    line += '[' + std::string(filled, '=') + std::string(bar - filled, ' ') + ']';
  }
  return (line + percent + rest).substr(0, width);
}

} // namespace tool
