/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <csignal>
#include <vector>

namespace pcl {
namespace kss {

/** \brief Gives the program its signal handlers back: an OpenCL driver can put its own
 * in their place when it comes up, as PoCL does for SIGINT, SIGTERM, SIGSEGV and a
 * dozen others. Signals without a handler of the program keep the driver's.
 */
class KeptSignalHandlers {
public:
  KeptSignalHandlers()
  {
    for (int signal = 1; signal < NSIG; ++signal) {
      struct sigaction action = {};
      if (sigaction(signal, nullptr, &action) == 0 && action.sa_handler != SIG_DFL)
        kept_.push_back({signal, action});
    }
  }

  ~KeptSignalHandlers()
  {
    for (const Kept& kept : kept_)
      sigaction(kept.signal, &kept.action, nullptr);
  }

  KeptSignalHandlers(const KeptSignalHandlers&) = delete;
  KeptSignalHandlers&
  operator=(const KeptSignalHandlers&) = delete;

private:
  struct Kept {
    int signal;
    struct sigaction action;
  };

  std::vector<Kept> kept_;
};

} // namespace kss
} // namespace pcl
