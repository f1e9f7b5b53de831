/*
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * Processes as they are without MPI.
 */

#include "processes.h"
#include "thread_crew.h"

#include <stdexcept>
#include <utility>

namespace tool {

class Processes::Ranks {};

Processes::Processes() = default;

Processes::~Processes() = default;

bool
Processes::leads() const
{
  return true;
}

std::size_t
Processes::number() const
{
  return 1;
}

std::unique_ptr<Crew>
Processes::crew(JobHandler handler, unsigned int threads) const
{
  return std::make_unique<ThreadCrew>(std::move(handler), threads);
}

void
Processes::serve(JobHandler, unsigned int) const
{
  throw std::logic_error("a process that is alone leads");
}

} // namespace tool
