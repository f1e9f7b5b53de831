/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <algorithm>
#include <chrono>
#include <cstdlib>

namespace tool {

/** \brief How long a rank sleeps before it looks for letters again: longer and longer
 * while none comes, since one that looks all the time takes a core from the work. */
class Pace {
public:
  std::chrono::microseconds
  next()
  {
    const auto pause = pause_;
    pause_ = std::min(2 * pause_, LONGEST);
    return pause;
  }

  void
  reset()
  {
    pause_ = SHORTEST;
  }

private:
  static constexpr std::chrono::microseconds SHORTEST{50}, LONGEST{2000};
  std::chrono::microseconds pause_ = SHORTEST;
};

/** \brief How long ranks may be silent. */
struct Patience {
  /** \brief One that has jobs, before they are given to others. */
  std::chrono::milliseconds with_worker = std::chrono::seconds(30);
  /** \brief The one that leads, whose disk may be slow. */
  std::chrono::milliseconds with_leader = std::chrono::seconds(600);
  /** \brief How often each is heard of. */
  std::chrono::milliseconds between_signs = std::chrono::seconds(1);

  /** \brief As the environment has it: PCL_KSS_ICP_RANK_PATIENCE, in seconds. */
  static Patience
  ofEnvironment()
  {
    Patience patience;
    const char* const text = std::getenv("PCL_KSS_ICP_RANK_PATIENCE");
    const double seconds = text ? std::atof(text) : 0.0;
    if (seconds > 0.0 && seconds < 1e6) {
      patience.with_worker =
          std::chrono::milliseconds(static_cast<long>(1e3 * seconds));
      patience.with_leader = 20 * patience.with_worker;
      patience.between_signs =
          std::min(patience.between_signs, patience.with_worker / 10);
    }
    return patience;
  }
};

} // namespace tool
