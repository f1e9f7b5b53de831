/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "evaluation_models.h"

#include "process_pool.h"

#include <gtest/gtest.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <iostream>
#include <map>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

using namespace evaluation;
using kss_test::textOf;

namespace {

constexpr double long_time = 60.0; // seconds

void
sleepFor(double seconds)
{
  std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
}

class EvaluationProcesses : public kss_test::FolderTest {
protected:
  std::string
  messages() const
  {
    return folder.path("messages.txt");
  }

  /** What becomes of several pieces of work, two at a time. */
  std::vector<Outcome>
  outcomesOf(const std::vector<ProcessPool::Work>& works,
             double time_limit = long_time) const
  {
    std::vector<Outcome> outcomes(works.size());
    std::vector<int> reports(works.size());
    ProcessPool pool(2, time_limit, messages());
    for (std::size_t i = 0; i < works.size(); ++i)
      pool.start(works[i], [&, i](const Outcome& outcome) {
        outcomes[i] = outcome;
        ++reports[i];
      });
    pool.finish();
    EXPECT_EQ(std::vector<int>(works.size(), 1), reports);
    return outcomes;
  }
};

std::string
fine()
{
  return "fine";
}

void
expectFine(const Outcome& outcome)
{
  EXPECT_EQ(Outcome::FINISHED, outcome.end);
  EXPECT_EQ("fine", outcome.answer);
  EXPECT_EQ(0, outcome.signal);
}

} // namespace

TEST_F(EvaluationProcesses, AnswersReachTheirJobs)
{
  std::vector<ProcessPool::Work> works;
  for (int i = 0; i < 50; ++i)
    works.push_back([i] { return std::to_string(i * i); });
  const auto outcomes = outcomesOf(works);
  for (int i = 0; i < 50; ++i) {
    EXPECT_EQ(Outcome::FINISHED, outcomes[i].end);
    EXPECT_EQ(std::to_string(i * i), outcomes[i].answer);
  }
}

TEST_F(EvaluationProcesses, WorkInAProcessOfTheirOwn)
{
  int touched = 0;
  const auto outcomes = outcomesOf({[&] {
                                      touched = 1;
                                      return std::to_string(getpid());
                                    },
                                    [] { return std::to_string(getpid()); }});
  EXPECT_EQ(0, touched);
  EXPECT_NE(std::to_string(getpid()), outcomes[0].answer);
  EXPECT_NE(outcomes[0].answer, outcomes[1].answer);
}

TEST_F(EvaluationProcesses, LargeAnswersArriveWhole)
{
  const auto large = [](char first) {
    std::string text(1 << 20, ' ');
    for (std::size_t i = 0; i < text.size(); ++i)
      text[i] = static_cast<char>(first + i % 61);
    return text;
  };
  const auto outcomes = outcomesOf({[=] { return large('!'); }, fine,
                                    [=] { return large('#'); }, [] { return ""; }});
  EXPECT_TRUE(outcomes[0].answer == large('!'));
  expectFine(outcomes[1]);
  EXPECT_TRUE(outcomes[2].answer == large('#'));
  EXPECT_EQ("", outcomes[3].answer);
  EXPECT_EQ(Outcome::FINISHED, outcomes[3].end);
}

TEST_F(EvaluationProcesses, CrashesAreReported)
{
  const auto outcomes =
      outcomesOf({fine,
                  []() -> std::string {
                    std::signal(SIGSEGV, SIG_DFL);
                    raise(SIGSEGV);
                    return "survived";
                  },
                  fine, []() -> std::string { std::abort(); }, fine,
                  []() -> std::string { throw std::runtime_error("thrown"); }, fine,
                  []() -> std::string { throw 1; }, fine,
                  []() -> std::string { _exit(3); }, fine});
  for (std::size_t i = 0; i < outcomes.size(); ++i)
    if (i % 2 == 0)
      expectFine(outcomes[i]);
    else
      EXPECT_EQ(Outcome::CRASHED, outcomes[i].end) << i;
  EXPECT_EQ(SIGSEGV, outcomes[1].signal);
  for (const std::size_t i : {3, 5, 7})
    EXPECT_EQ(SIGABRT, outcomes[i].signal) << i;
  EXPECT_EQ(0, outcomes[9].signal);
}

TEST_F(EvaluationProcesses, TimesOut)
{
  const auto forever = [] {
    sleepFor(long_time);
    return std::string("late");
  };
  const auto busy = []() -> std::string {
    for (volatile int i = 0;; i = 1 - i)
      ;
  };
  const auto outcomes = outcomesOf({forever, fine, busy, fine, fine}, 1.0);
  for (const std::size_t i : {0, 2}) {
    EXPECT_EQ(Outcome::TIMED_OUT, outcomes[i].end);
    EXPECT_EQ("", outcomes[i].answer);
    EXPECT_GE(outcomes[i].wall_seconds, 1.0);
    EXPECT_LT(outcomes[i].wall_seconds, 10.0);
  }
  for (const std::size_t i : {1, 3, 4}) {
    expectFine(outcomes[i]);
    EXPECT_LT(outcomes[i].wall_seconds, 1.0);
  }
}

TEST_F(EvaluationProcesses, RunsAsManyAsAllowed)
{
  using Clock = std::chrono::steady_clock; // the same for all processes
  const auto now = [] {
    return std::chrono::duration<double>(Clock::now().time_since_epoch()).count();
  };
  for (const unsigned int jobs : {1u, 3u}) {
    std::multimap<double, int> changes; // of the number of processes
    ProcessPool pool(jobs, long_time, messages());
    for (int i = 0; i < 6; ++i)
      pool.start(
          [&] {
            const double start = now();
            sleepFor(0.05);
            return std::to_string(start) + ' ' + std::to_string(now());
          },
          [&](const Outcome& outcome) {
            std::istringstream times(outcome.answer);
            double start = 0.0, end = 0.0;
            EXPECT_TRUE(times >> start >> end);
            changes.insert({start, 1});
            changes.insert({end, -1});
          });
    pool.finish();
    int running = 0, most = 0;
    for (const auto& [time, change] : changes)
      most = std::max(most, running += change);
    EXPECT_EQ(static_cast<int>(jobs), most);
    EXPECT_EQ(12u, changes.size());
  }
}

TEST_F(EvaluationProcesses, CanBeUsedAgain)
{
  ProcessPool pool(2, long_time, messages());
  int done = 0;
  for (int round = 1; round <= 2; ++round) {
    for (int i = 0; i < 3; ++i)
      pool.start(fine, [&](const Outcome&) { ++done; });
    pool.finish();
    EXPECT_EQ(3 * round, done);
  }
}

TEST_F(EvaluationProcesses, EndWithThePool)
{
  const std::string id_file = folder.path("id");
  pid_t id = 0;
  {
    ProcessPool pool(1, long_time, messages());
    pool.start(
        [&] {
          std::ofstream(id_file) << getpid() << std::endl;
          sleepFor(long_time);
          return std::string();
        },
        [](const Outcome&) { FAIL(); });
    while (textOf(id_file).find('\n') == std::string::npos)
      sleepFor(0.01);
    std::ifstream(id_file) >> id;
    ASSERT_EQ(0, kill(id, 0));
  }
  EXPECT_EQ(-1, kill(id, 0));
  EXPECT_EQ(ESRCH, errno);
}

TEST_F(EvaluationProcesses, MessagesGoToTheirFile)
{
  ::testing::internal::CaptureStdout();
  ::testing::internal::CaptureStderr();
  outcomesOf({[] {
                std::cerr << "complaint\n";
                return fine();
              },
              []() -> std::string {
                std::cerr << "last words\n";
                std::abort();
              },
              [] {
                std::cout << "remark" << std::endl;
                return fine();
              }});
  EXPECT_EQ("", ::testing::internal::GetCapturedStdout());
  EXPECT_EQ("", ::testing::internal::GetCapturedStderr());
  for (const char* message : {"complaint\n", "last words\n", "remark\n"})
    EXPECT_NE(std::string::npos, textOf(messages()).find(message)) << message;
}

TEST_F(EvaluationProcesses, NeedAFileForMessages)
{
  const std::string path = folder.path("missing/messages.txt");
  try {
    ProcessPool pool(1, long_time, path);
    FAIL();
  }
  catch (const std::runtime_error& problem) {
    EXPECT_EQ(0u, std::string(problem.what()).find(path + ": ")) << problem.what();
  }
}
