/*
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * Loops that threads share, and what ends them early.
 */

#include "faults/thread_faults.h"
#include "support/parallel.h"

#include <gtest/gtest.h>

#include <numeric>
#include <set>
#include <string>

namespace {

using namespace kss_test;
using namespace pcl::kss;

/** Calls for each of a thousand, each once? */
void
expectAllDone(unsigned int threads)
{
  std::vector<std::atomic<int>> calls(1000);
  inParallel(calls.size(), threads, 7, [&](std::ptrdiff_t i) { ++calls[i]; });
  for (const auto& number : calls)
    ASSERT_EQ(1, number);
}

TEST(InParallel, DoesEverythingOnce)
{
  for (const unsigned int threads : {0u, 1u, 2u, 5u, 3000u})
    expectAllDone(threads);
  inParallel(0, 4, 1, [](std::ptrdiff_t) { FAIL(); });
}

TEST(InParallel, GoesOnWithTheThreadsThatThereAre)
{
  for (const int allowed : {0, 1, 3}) {
    const ThreadFaults faults(allowed);
    expectAllDone(8);
    EXPECT_GT(faults.refused(), 0);
  }
}

TEST(InParallel, ThrowsWhatAWorkerThrows)
{
  for (const unsigned int threads : {1u, 4u}) {
    std::atomic<int> running{0};
    // whichever thread it is that meets the bad one
    for (const std::ptrdiff_t bad : {0, 500, 999}) {
      try {
        inParallel(1000, threads, 3, [&](std::ptrdiff_t i) {
          ++running;
          std::this_thread::yield();
          --running;
          if (i == bad)
            throw std::string("bad");
        });
        FAIL() << "nothing was thrown";
      }
      catch (const std::string& thrown) {
        EXPECT_EQ("bad", thrown);
      }
      EXPECT_EQ(0, running); // all threads have ended
    }
  }
}

TEST(InParallel, LeavesOutTheRestAfterAnError)
{
  std::atomic<int> calls{0};
  EXPECT_THROW(inParallel(1000000, 4, 1,
                          [&](std::ptrdiff_t) {
                            ++calls;
                            throw std::runtime_error("at once");
                          }),
               std::runtime_error);
  EXPECT_LE(calls, 4);
}

TEST(InParallel, StopsWhenTold)
{
  for (const unsigned int threads : {1u, 4u}) {
    StopSignal signal;
    const HeedingSignal heeding(&signal);
    std::atomic<int> calls{0};
    EXPECT_THROW(inParallel(1000000, threads, 10,
                            [&](std::ptrdiff_t) {
                              if (++calls == 100)
                                signal.cancel();
                            }),
                 Stopped);
    EXPECT_LT(calls, 100 + 10 * 4 + 1);
  }
}

TEST(StopSignal, IsHeededAsLongAsSomeoneSaysSo)
{
  StopSignal outer, inner;
  outer.cancel();
  EXPECT_NO_THROW(throwIfStopped());
  {
    const HeedingSignal heeding(&outer);
    EXPECT_THROW(throwIfStopped(), Stopped);
    {
      const HeedingSignal other(&inner);
      EXPECT_NO_THROW(throwIfStopped());
    }
    EXPECT_THROW(throwIfStopped(), Stopped);
    std::thread([] { EXPECT_NO_THROW(throwIfStopped()); }).join();
  }
  EXPECT_NO_THROW(throwIfStopped());
}

TEST(StopSignal, SaysWhy)
{
  const auto why = [](const StopSignal& signal) -> std::string {
    try {
      signal.throwIfSet();
      return "";
    }
    catch (const Stopped& stopped) {
      return stopped.what();
    }
  };
  StopSignal signal;
  EXPECT_EQ("", why(signal));
  signal.restart(1e-3);
  std::this_thread::sleep_for(std::chrono::milliseconds(3));
  EXPECT_EQ("The time limit of 0.001 s has passed", why(signal));
  signal.cancel();
  EXPECT_EQ("The registration was cancelled", why(signal));
  for (const double never : {0.0, 1e9, 1e30, std::numeric_limits<double>::infinity()}) {
    signal.restart(never);
    EXPECT_FALSE(signal.isSet()) << never;
  }
}

} // namespace
