/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "thread_crew.h"

#include <algorithm>
#include <utility>

namespace tool {

ThreadCrew::ThreadCrew(JobHandler handler, unsigned int threads)
: workers_(std::move(handler),
           threads > 0 ? threads : std::max(1u, std::thread::hardware_concurrency()))
{
}

void
ThreadCrew::run(std::size_t jobs,
                const std::function<std::string(std::size_t)>& job,
                const std::function<void(std::size_t, JobAnswer)>& done)
{
  const std::uint64_t first = std::exchange(ticket_, ticket_ + jobs);
  for (std::size_t begun = 0, ended = 0; ended < jobs;) {
    for (; begun < jobs && begun - ended < workers_.threads(); ++begun)
      workers_.give(first + begun, job(begun));
    auto answer = workers_.take(std::chrono::hours(1));
    if (!answer || answer->ticket < first)
      continue;
    ++ended;
    done(answer->ticket - first, std::move(answer->answer));
  }
}

} // namespace tool
