/*
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * Those who do jobs side by side: each job once, whatever becomes of it.
 */

#include "crew/thread_crew.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace {

using namespace tool;

std::string
twice(const std::string& job)
{
  return job + job;
}

TEST(ThreadCrew, DoesEachJobOnce)
{
  ThreadCrew crew(twice, 3);
  for (const std::size_t jobs : {std::size_t(0), std::size_t(1), std::size_t(200)}) {
    std::vector<int> times(jobs, 0);
    crew.run(
        jobs, [](std::size_t i) { return std::to_string(i); },
        [&](std::size_t i, const JobAnswer& answer) {
          ++times[i];
          EXPECT_EQ(std::to_string(i) + std::to_string(i), answer.bytes);
          EXPECT_EQ("", answer.failure);
        });
    EXPECT_EQ(std::vector<int>(jobs, 1), times);
  }
}

TEST(ThreadCrew, AsksForJobsWhenSomebodyIsFree)
{
  ThreadCrew crew(twice, 2);
  std::size_t asked = 0, ended = 0, most = 0;
  crew.run(
      50,
      [&](std::size_t i) {
        EXPECT_EQ(asked, i);
        ++asked;
        most = std::max(most, asked - ended);
        return std::to_string(i);
      },
      [&](std::size_t, const JobAnswer&) { ++ended; });
  EXPECT_EQ(2u, most);
}

TEST(ThreadCrew, UsesAllThreads)
{
  std::atomic<int> inside{0};
  // each waits for the other
  ThreadCrew crew(
      [&](const std::string&) {
        ++inside;
        for (int i = 0; i < 2000 && inside < 2; ++i)
          std::this_thread::sleep_for(std::chrono::milliseconds(5));
        return std::string();
      },
      2);
  crew.run(
      2, [](std::size_t) { return ""; }, [](std::size_t, const JobAnswer&) {});
  EXPECT_EQ(2, inside);
}

TEST(ThreadCrew, TellsWhatIsThrown)
{
  ThreadCrew crew(
      [](const std::string& job) -> std::string {
        if (job == "1")
          throw std::runtime_error("no good");
        if (job == "2")
          throw std::bad_alloc();
        return "done";
      },
      2);
  std::vector<std::string> failures(4);
  crew.run(
      4, [](std::size_t i) { return std::to_string(i); },
      [&](std::size_t i, const JobAnswer& answer) { failures[i] = answer.failure; });
  EXPECT_EQ(
      (std::vector<std::string>{"", "no good", "needs more memory than there is", ""}),
      failures);
}

TEST(ThreadCrew, GoesOnAfterARunThatWasGivenUp)
{
  ThreadCrew crew(twice, 2);
  EXPECT_THROW(crew.run(
                   20, [](std::size_t) { return "a"; },
                   [](std::size_t, const JobAnswer&) {
                     throw std::runtime_error("the disk is full");
                   }),
               std::runtime_error);
  std::vector<std::string> answers(20);
  crew.run(
      20, [](std::size_t i) { return std::to_string(i); },
      [&](std::size_t i, const JobAnswer& answer) { answers[i] = answer.bytes; });
  for (std::size_t i = 0; i < answers.size(); ++i)
    EXPECT_EQ(std::to_string(i) + std::to_string(i), answers[i]);
}

} // namespace
