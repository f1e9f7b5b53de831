/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "workers.h"

#include <algorithm>
#include <exception>
#include <new>
#include <system_error>
#include <utility>

namespace tool {

Workers::Workers(JobHandler handler, unsigned int threads)
: handler_(std::move(handler))
{
  threads_.reserve(threads);
  try {
    for (unsigned int i = 0; i < std::max(threads, 1u); ++i)
      threads_.emplace_back([this] { work(); });
  }
  catch (const std::system_error&) {
    if (threads_.empty()) // those that there are do the work
      throw;
  }
}

Workers::~Workers()
{
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    is_ending_ = true;
  }
  has_job_.notify_all();
  for (std::thread& thread : threads_)
    thread.join();
}

void
Workers::give(std::uint64_t ticket, std::string job)
{
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    jobs_.push_back({ticket, std::move(job)});
  }
  has_job_.notify_one();
}

std::optional<Workers::Done>
Workers::take(std::chrono::microseconds patience)
{
  std::unique_lock<std::mutex> lock(mutex_);
  if (!has_answer_.wait_for(lock, patience, [this] { return !answers_.empty(); }))
    return std::nullopt;
  Done first = std::move(answers_.front());
  answers_.pop_front();
  return first;
}

void
Workers::work()
{
  std::unique_lock<std::mutex> lock(mutex_);
  while (true) {
    has_job_.wait(lock, [this] { return is_ending_ || !jobs_.empty(); });
    if (is_ending_)
      return;
    const Job job = std::move(jobs_.front());
    jobs_.pop_front();
    lock.unlock();
    Done done{job.ticket, answerTo(job.bytes)};
    lock.lock();
    answers_.push_back(std::move(done));
    has_answer_.notify_one();
  }
}

JobAnswer
Workers::answerTo(const std::string& job) const
{
  const auto failed = [](const char* why) {
    return JobAnswer{"", *why ? why : "failed without a reason"};
  };
  try {
    return {handler_(job), ""};
  }
  catch (const std::bad_alloc&) {
    return failed("needs more memory than there is");
  }
  catch (const std::exception& problem) {
    return failed(problem.what());
  }
}

} // namespace tool
