/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <chrono>
#include <string>
#include <vector>

namespace pcl {
namespace kss {

/** \brief Wall time of one stage. */
struct StageSeconds {
  std::string stage;
  double seconds;
};

/** \brief Measures stages that follow each other. */
class StageClock {
public:
  /** \brief Forget all stages and start the first. */
  void
  restart()
  {
    stages_.clear();
    lap_ = std::chrono::steady_clock::now();
  }

  /** \brief End the running stage, name it, and start the next. */
  void
  lap(const std::string& stage)
  {
    const auto now = std::chrono::steady_clock::now();
    stages_.push_back({stage, std::chrono::duration<double>(now - lap_).count()});
    lap_ = now;
  }

  /** \brief The stages so far, in their order. */
  const std::vector<StageSeconds>&
  stages() const
  {
    return stages_;
  }

private:
  std::vector<StageSeconds> stages_;
  std::chrono::steady_clock::time_point lap_ = std::chrono::steady_clock::now();
};

} // namespace kss
} // namespace pcl
