/*
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * Does jobs under mpirun --enable-recovery, which does not tell how they ended: the
 * last line of the output does. Some ranks are killed by what they do.
 */

#include "crew/processes.h"

#include <chrono>
#include <csignal>
#include <iostream>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace {

using namespace tool;

constexpr std::size_t JOBS = 60, KILLER = 5, THROWER = 7, LARGE = 9;

void
expect(bool is_right, const std::string& what)
{
  if (!is_right)
    throw std::runtime_error(what);
}

std::string
answerTo(const std::string& job, bool leads)
{
  if (leads) // has no time for the one that kills
    std::this_thread::sleep_for(std::chrono::milliseconds(1500));
  if (job == "kill")
    std::raise(SIGKILL);
  if (job == "throw")
    throw std::runtime_error("thrown");
  std::this_thread::sleep_for(std::chrono::milliseconds(5));
  return job + job;
}

void
lead(Crew& crew)
{
  const std::string large(3000000, 'x');
  const auto job = [&](std::size_t i) {
    return i == KILLER    ? "kill"
           : i == THROWER ? "throw"
           : i == LARGE   ? large
                          : std::to_string(i);
  };
  std::vector<int> times(JOBS, 0);
  crew.run(JOBS, job, [&](std::size_t i, const JobAnswer& answer) {
    ++times[i];
    if (i == KILLER)
      expect(answer.failure.find("ended") != std::string::npos, "the killer");
    else if (i == THROWER)
      expect(answer.failure == "thrown" && answer.bytes.empty(), "the thrower");
    else
      expect(answer.failure.empty() && answer.bytes == job(i) + job(i), "an answer");
  });
  expect(times == std::vector<int>(JOBS, 1), "each job once");

  // one that is given up, and one after it
  bool is_thrown = false;
  try {
    crew.run(
        20, [](std::size_t) { return "old"; },
        [](std::size_t, const JobAnswer&) { throw std::runtime_error("given up"); });
  }
  catch (const std::runtime_error&) {
    is_thrown = true;
  }
  expect(is_thrown, "what is thrown");
  std::size_t ended = 0;
  crew.run(
      20, [](std::size_t i) { return std::to_string(i); },
      [&](std::size_t i, const JobAnswer& answer) {
        ++ended;
        expect(answer.bytes == std::to_string(i) + std::to_string(i), "a later run");
      });
  expect(ended == 20, "all of a later run");
}

} // namespace

int
main()
{
  const Processes processes;
  const bool leads = processes.leads();
  const auto handler = [=](const std::string& job) { return answerTo(job, leads); };
  try {
    if (leads) {
      expect(processes.number() == 4, "four ranks");
      lead(*processes.crew(handler, 1));
      std::cout << "all as it should be" << std::endl;
    }
    else
      processes.serve(handler, 2);
    return 0;
  }
  catch (const std::exception& problem) {
    std::cout << "wrong: " << problem.what() << std::endl;
  }
  return 1;
}
