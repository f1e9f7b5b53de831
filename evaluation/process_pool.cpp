/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "process_pool.h"

#include "../benchmarks/process.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <iostream>
#include <stdexcept>
#include <utility>
#include <vector>

namespace evaluation {
namespace {

using benchmarks::wallSeconds;

[[noreturn]] void
fail(const std::string& what)
{
  throw std::runtime_error(what + ": " + std::strerror(errno));
}

/** \brief Have SIGPROF end this process after so many seconds of its CPU time. */
void
endAfter(double seconds)
{
  itimerval timer = {};
  timer.it_value.tv_sec = static_cast<time_t>(seconds);
  timer.it_value.tv_usec = static_cast<suseconds_t>(
      1e6 * (seconds - static_cast<double>(timer.it_value.tv_sec)));
  setitimer(ITIMER_PROF, &timer, nullptr);
}

/** \brief In the new process: do the work, write the answer, and leave without the
 * destructors of what belongs to the old one. What is thrown counts as a crash.
 */
[[noreturn]] void
workInChild(const ProcessPool::Work& work,
            double time_limit,
            int answer_end,
            int messages) noexcept
{
  endAfter(time_limit);
  prctl(PR_SET_PDEATHSIG, SIGKILL); // nothing is left running when the parent dies
  dup2(messages, STDOUT_FILENO);
  dup2(messages, STDERR_FILENO);
  const std::string answer = work();
  std::cout.flush();
  std::fflush(nullptr); // _exit() does not
  std::size_t written = 0;
  while (written < answer.size()) {
    const ssize_t bytes =
        write(answer_end, answer.data() + written, answer.size() - written);
    if (bytes < 0)
      _exit(1);
    written += static_cast<std::size_t>(bytes);
  }
  _exit(0);
}

} // namespace

ProcessPool::ProcessPool(unsigned int jobs,
                         double time_limit,
                         const std::string& messages)
: jobs_(std::max(jobs, 1u))
, time_limit_(time_limit)
, wall_limit_(4.0 * time_limit)
, messages_(open(messages.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644))
{
  if (messages_ < 0)
    fail(messages);
}

ProcessPool::~ProcessPool()
{
  for (const auto& process : running_) {
    kill(process.id, SIGKILL);
    waitpid(process.id, nullptr, 0);
    close(process.answer);
  }
  close(messages_);
}

void
ProcessPool::start(const Work& work, Done done)
{
  while (running_.size() >= jobs_)
    waitForOne();

  int ends[2];
  if (pipe(ends) != 0)
    fail("no pipe for another process");
  std::cout.flush(); // or the process would write it again
  std::fflush(nullptr);
  const pid_t id = fork();
  if (id < 0)
    fail("cannot start another process");
  if (id == 0) {
    close(ends[0]);
    workInChild(work, time_limit_, ends[1], messages_);
  }
  close(ends[1]);
  running_.push_back({id, ends[0], wallSeconds(), std::move(done), {}});
}

void
ProcessPool::finish()
{
  while (!running_.empty())
    waitForOne();
}

void
ProcessPool::waitForOne()
{
  while (true) {
    double first_deadline = running_.front().start + wall_limit_;
    std::vector<pollfd> ends;
    for (const auto& process : running_) {
      ends.push_back({process.answer, POLLIN, 0});
      first_deadline = std::min(first_deadline, process.start + wall_limit_);
    }
    const double left = std::max(0.0, first_deadline - wallSeconds());
    poll(ends.data(), ends.size(), static_cast<int>(1000.0 * std::min(left, 1e6)) + 1);

    std::size_t i = 0;
    for (auto process = running_.begin(); process != running_.end(); ++process, ++i) {
      char buffer[4096];
      const ssize_t bytes =
          ends[i].revents ? read(process->answer, buffer, sizeof(buffer)) : -1;
      if (bytes > 0) {
        process->outcome.answer.append(buffer, static_cast<std::size_t>(bytes));
      }
      else if (bytes == 0) {
        end(process);
        return;
      }
      else if (wallSeconds() > process->start + wall_limit_) {
        kill(process->id, SIGKILL);
        process->outcome.end = Outcome::TIMED_OUT;
        end(process);
        return;
      }
    }
  }
}

void
ProcessPool::end(std::list<Process>::iterator process)
{
  int status = 0;
  waitpid(process->id, &status, 0);
  close(process->answer);
  Outcome outcome = std::move(process->outcome);
  outcome.wall_seconds = wallSeconds() - process->start;
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGPROF)
    outcome.end = Outcome::TIMED_OUT;
  if (outcome.end != Outcome::TIMED_OUT)
    outcome.end = WIFEXITED(status) && WEXITSTATUS(status) == 0 ? Outcome::FINISHED
                                                                : Outcome::CRASHED;
  if (WIFSIGNALED(status))
    outcome.signal = WTERMSIG(status);
  const Done done = std::move(process->done);
  running_.erase(process);
  done(outcome);
}

} // namespace evaluation
