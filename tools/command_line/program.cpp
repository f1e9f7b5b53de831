/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "program.h"

#include <pcl/console/print.h>

#include <algorithm>
#include <cctype>
#include <new>
#include <stdexcept>

namespace tool {

void
complain(const std::string& program, std::string message)
{
  std::replace_if(
      message.begin(), message.end(), [](unsigned char c) { return std::iscntrl(c); },
      ' ');
  std::cerr << program << ": " << message << '\n';
}

int
guarded(const std::string& program, const std::function<int()>& run)
{
  // All that PCL has to say about files and registrations is said by the program, once.
  pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
  try {
    const int status = run();
    if (!std::cout.flush())
      throw std::runtime_error("cannot write to standard output");
    return status;
  }
  catch (const std::bad_alloc&) {
    complain(program, "needs more memory than there is");
  }
  catch (const std::exception& problem) {
    complain(program, problem.what());
  }
  return FAILED;
}

} // namespace tool
