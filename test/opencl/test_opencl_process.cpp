/*
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * What OpenCL drivers do to a process: one forked from a process that uses a device has
 * none of the driver's threads; when they come up, they take threads and signals.
 */

#include "evaluators/evaluator_answers.h"
#include "evaluators/pair_distances.h"
#include "faults/opencl_faults.h"
#include "faults/thread_faults.h"

#include <pcl/registration/kss/devices.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <cstdlib>
#include <functional>
#include <thread>

#include <sys/wait.h>
#include <unistd.h>

static bool is_child = false;

/** The leak sanitizer asks for this when a program ends. A child leaves the objects of
 * its parent's devices alone, and has none of the stacks that hold others. */
extern "C" int
__lsan_is_turned_off()
{
  return is_child;
}

namespace {

using namespace kss_test;
using namespace pcl::kss;

/** How a child ends that does something, ten seconds at most: 0, where that is true. */
int
inChild(const std::function<bool()>& work)
{
  const pid_t child = fork();
  if (child == 0) {
    is_child = true;
    alarm(10);
    bool is_right = false;
    try {
      is_right = work();
    }
    catch (const std::exception& error) {
      std::fprintf(stderr, "%s\n", error.what());
    }
    std::exit(is_right ? 0 : 1); // with all that is done at the end of a program
  }
  int status = -1;
  waitpid(child, &status, 0);
  return status;
}

class Fork : public ::testing::Test {
protected:
  void
  SetUp() override
  {
    if (openCLDeviceNames().empty())
      GTEST_SKIP() << "There is no OpenCL device on this machine.";
    settings_.threads = 1;
  }

  Answers
  onHost() const
  {
    Settings settings = settings_;
    settings.device = "host";
    return answersOf(settings);
  }

  Settings settings_;
};

TEST_F(Fork, LeavesTheWorkOfTheChildToTheHost)
{
  const Answers on_device = answersOf(settings_), on_host = onHost();
  EXPECT_EQ(0, inChild([&] {
              const Answers found = answersOf(settings_);
              return found.device == "host" && found.bits == on_host.bits &&
                     openCLDeviceNames().empty();
            }));
  EXPECT_EQ(on_device.bits, answersOf(settings_).bits);
}

TEST_F(Fork, LeavesTheWorkOfAParentsEvaluatorsToTheHost)
{
  auto evaluators = std::make_unique<Evaluators>(settings_);
  evaluators->setClouds(100);
  const Answers on_device = evaluators->ask(30), on_host = onHost();
  EXPECT_NE("host", on_device.device);
  EXPECT_EQ(0, inChild([&] {
              const Answers found = evaluators->ask(30);
              evaluators.reset();
              return found.device == "host" && found.bits == on_host.bits;
            }));
  EXPECT_EQ(0, inChild([&] {
              evaluators.reset();
              return true;
            }));
  EXPECT_EQ(on_device.bits, evaluators->ask(30).bits);
}

TEST_F(Fork, IsAnErrorOfTheChildWhereItAsksForADevice)
{
  settings_.device = openCLDeviceNames().front();
  auto evaluators = std::make_unique<Evaluators>(settings_);
  evaluators->setClouds(100);
  const auto isToldOfTheFork = [](const std::function<void()>& work) {
    try {
      work();
    }
    catch (const DeviceError& error) {
      return std::string(error.what()).find("forked") != std::string::npos;
    }
    return false;
  };
  EXPECT_EQ(0, inChild([&] {
              const bool is_told = isToldOfTheFork([&] { evaluators->ask(30); }) &&
                                   isToldOfTheFork([&] { answersOf(settings_); });
              evaluators.reset();
              return is_told;
            }));
}

TEST_F(Fork, DoesNotWaitForAThreadOfTheParent)
{
  // some of these forks happen while that thread has whatever can be locked
  answersOf(settings_);
  std::atomic<bool> is_done{false};
  std::thread other([&] {
    while (!is_done)
      makeOpenCLPairDistances("auto", 1);
  });
  for (int i = 0; i < 30; ++i)
    EXPECT_EQ(0, inChild([&] {
                return makePairDistances(settings_)->deviceName() == "host";
              }));
  is_done = true;
  other.join();
}

/** Before anything else here has called OpenCL: run by ctest on its own. */
TEST(ForkBefore, LeavesTheChildItsDevice)
{
  if (callsOf("clGetPlatformIDs") > 0)
    GTEST_SKIP() << "This process has called OpenCL.";
  Settings settings;
  const auto hasDevice = [&] {
    return makePairDistances(settings)->deviceName() != "host";
  };
  const int status = inChild(hasDevice);
  if (!hasDevice())
    GTEST_SKIP() << "There is no OpenCL device on this machine.";
  EXPECT_EQ(0, status);
}

/** The same for what a driver does when it comes up. */
class ProcessBefore : public ::testing::Test {
protected:
  void
  SetUp() override
  {
    if (callsOf("clGetPlatformIDs") > 0)
      GTEST_SKIP() << "This process has called OpenCL.";
  }
};

TEST_F(ProcessBefore, KeepsItsSignalHandlers)
{
  const int status = inChild([] {
    const auto handler = [](int) {};
    const auto isKept = [&](int signal) {
      struct sigaction action = {};
      sigaction(signal, nullptr, &action);
      return action.sa_handler == static_cast<void (*)(int)>(handler);
    };
    const int signals[] = {SIGINT, SIGTERM, SIGHUP, SIGSEGV, SIGUSR1, SIGUSR2};
    for (const int signal : signals)
      std::signal(signal, handler);
    openCLDeviceNames();
    return std::all_of(std::begin(signals), std::end(signals), isKept);
  });
  EXPECT_EQ(0, status);
}

TEST_F(ProcessBefore, IsNotEndedWhereThereAreNoThreadsForTheDriver)
{
  const int status = inChild([] {
    Settings settings;
    settings.threads = 1;
    {
      const ThreadFaults faults(0);
      if (makePairDistances(settings)->deviceName() != "host")
        return false;
    }
    // once there are threads, there is a device
    return makePairDistances(settings)->deviceName() != "host" ||
           openCLDeviceNames().empty();
  });
  EXPECT_EQ(0, status);
}

} // namespace
