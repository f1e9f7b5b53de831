/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "crew.h"

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

namespace tool {

/** \brief Threads that do jobs. Each job has a ticket, which is on its answer, too. */
class Workers {
public:
  struct Done {
    std::uint64_t ticket;
    JobAnswer answer;
  };

  /** \param[in] threads at least one */
  Workers(JobHandler handler, unsigned int threads);

  /** \brief Waits for what has begun; the rest is not done. */
  ~Workers();

  std::size_t
  threads() const
  {
    return threads_.size();
  }

  void
  give(std::uint64_t ticket, std::string job);

  /** \brief The answer that came first; nothing where there is none in time. */
  std::optional<Done>
  take(std::chrono::microseconds patience);

private:
  struct Job {
    std::uint64_t ticket;
    std::string bytes;
  };

  void
  work();

  JobAnswer
  answerTo(const std::string& job) const;

  const JobHandler handler_;
  std::mutex mutex_;
  std::condition_variable has_job_, has_answer_;
  std::deque<Job> jobs_;
  std::deque<Done> answers_;
  bool is_ending_ = false;
  std::vector<std::thread> threads_;
};

} // namespace tool
