/*
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * A device that fails, at any call: with "auto" the host goes on, and a device asked
 * for by name is an error that names the call.
 */

#include "evaluators/evaluator_answers.h"
#include "evaluators/pair_distances.h"
#include "faults/opencl_faults.h"

#include <pcl/registration/kss/alignment.h>
#include <pcl/registration/kss/devices.h>

#include <gtest/gtest.h>

#include <algorithm>

namespace {

using namespace kss_test;
using namespace pcl::kss;

Settings
on(const std::string& device, unsigned int threads = 1)
{
  Settings settings;
  settings.device = device;
  settings.threads = threads;
  return settings;
}

/** So that a run does not find a program that another one has built. */
void
loseProgram(const Settings& settings)
{
  failAt(0);
  failAlways("clGetPlatformIDs", -5);
  failAlways("clCreateBuffer", -5);
  for (int i = 0; i < 2; ++i) // then it is not even kept as a lost one
    EXPECT_THROW(
        {
          const auto evaluator =
              makeOpenCLPairDistances(settings.device, settings.threads);
          evaluator->setClouds(Points::Zero(3, 1), Points::Zero(3, 1));
        },
        DeviceError);
  failAlways("clGetPlatformIDs", 0);
  failAlways("clCreateBuffer", 0);
  failAt(0);
}

/** Calls whose failure may change nothing. */
bool
isRelease(const std::string& call)
{
  return call.rfind("clRelease", 0) == 0;
}

/** What the OpenCL headers for C++ call it. */
std::string
nameOf(const std::string& call)
{
  return isRelease(call)                  ? "Release Object"
         : call.rfind("clRetain", 0) == 0 ? "Retain Object"
                                          : call;
}

class OpenCLFaults : public ::testing::Test {
protected:
  void
  SetUp() override
  {
    if (openCLDeviceNames().empty())
      GTEST_SKIP() << "There is no OpenCL device on this machine.";
    name_ = openCLDeviceNames().front();
  }

  void
  TearDown() override
  {
    failAt(0);
    showBrokenPlatform(false);
    claimLargestBuffer(0);
  }

  std::string name_;
};

TEST_F(OpenCLFaults, LeaveTheWorkToTheHostWhereAnyDeviceWillDo)
{
  const Settings settings = on("auto");
  const Answers on_host = answersOf(on("host"));
  answersOf(settings);
  loseProgram(settings); // the last one that was lost is kept
  answersOf(settings);
  const long live = liveObjects();
  loseProgram(settings);
  const Answers on_device = answersOf(settings);
  const long calls = callsMade();
  ASSERT_GT(calls, 100);
  EXPECT_EQ(live, liveObjects());
  EXPECT_NE("host", on_device.device);
  testing::internal::CaptureStderr();
  testing::internal::CaptureStdout();
  for (long call = 1; call <= calls; ++call) {
    loseProgram(settings);
    failAt(call);
    const Answers found = answersOf(settings);
    SCOPED_TRACE("call " + std::to_string(call) + ", " + failedCall());
    ASSERT_NE("", failedCall());
    EXPECT_TRUE(found.device == "host" || isRelease(failedCall()));
    // a program that is lost is so for all that are asked later; a buffer that cannot
    // be released loses none
    bool is_host = false;
    for (std::size_t i = 0; i < found.bits.size(); ++i) {
      const bool is_from_device = found.bits[i] == on_device.bits[i];
      is_host = !is_from_device || (is_host && !isRelease(failedCall()));
      EXPECT_TRUE(is_from_device || found.bits[i] == on_host.bits[i]) << i;
      EXPECT_TRUE(!is_host || found.bits[i] == on_host.bits[i]) << i;
    }
    if (found.device == "host") {
      EXPECT_EQ(on_host.bits.back(), found.bits.back());
    }
  }
  const std::string said =
      testing::internal::GetCapturedStderr() + testing::internal::GetCapturedStdout();
  const std::string warning = "The search runs on the host instead";
  const auto first = said.find(warning);
  EXPECT_NE(std::string::npos, first) << said;
  EXPECT_EQ(first, said.rfind(warning)) << said;
  // the next object has the device again, and nothing has been lost on the way
  failAt(0);
  const Answers again = answersOf(settings);
  EXPECT_EQ(on_device.device, again.device);
  EXPECT_EQ(on_device.bits, again.bits);
  EXPECT_EQ(live, liveObjects());
}

TEST_F(OpenCLFaults, AreErrorsThatNameTheCallOfADeviceAskedForByName)
{
  const Settings settings = on(name_);
  answersOf(settings);
  loseProgram(settings); // the last one that was lost is kept
  const Answers on_device = answersOf(settings);
  const long calls = callsMade(), live = liveObjects();
  for (long call = 1; call <= calls; ++call) {
    loseProgram(settings);
    failAt(call, -6);
    try {
      const Answers found = answersOf(settings);
      EXPECT_TRUE(isRelease(failedCall())) << failedCall();
      EXPECT_EQ(on_device.bits, found.bits);
    }
    catch (const DeviceError& error) {
      const std::string text = error.what();
      EXPECT_NE(std::string::npos, text.find(nameOf(failedCall()))) << text;
      EXPECT_NE(std::string::npos, text.find("error -6")) << text;
    }
  }
  failAt(0);
  EXPECT_EQ(on_device.bits, answersOf(settings).bits);
  EXPECT_EQ(live, liveObjects());
}

TEST_F(OpenCLFaults, DoNotChangeAnAlignment)
{
  const LocalCloud source{sampled(creature(), 600, 3), Eigen::Vector3d::Zero()};
  const LocalCloud target{sampled(creature(), 600, 4), Eigen::Vector3d::Zero()};
  const auto aligned = [&](Settings settings) {
    settings.sample_points = 150;
    settings.mode = Mode::GLOBAL_GLOBAL;
    Alignment alignment(settings);
    Stages stages;
    const auto found = alignment.align(source, target, {}, stages).alternatives;
    return std::make_pair(found.front().transformation, alignment.deviceName());
  };
  const auto expected = aligned(on("host"));
  const Settings settings = on("auto");
  loseProgram(settings);
  aligned(settings);
  const long calls = callsMade();
  for (long call = 1; call <= calls; call += calls / 12) {
    loseProgram(settings);
    failAt(call);
    const auto found = aligned(settings);
    SCOPED_TRACE("call " + std::to_string(call) + ", " + failedCall());
    EXPECT_EQ(expected.first, found.first);
    if (!isRelease(failedCall())) {
      EXPECT_EQ("host", found.second);
    }
  }
}

TEST_F(OpenCLFaults, OfABuildAreNotTriedAgain)
{
  const Settings settings = on("auto", 0);
  loseProgram(settings);
  failAlways("clBuildProgram", -11);
  const long before = callsOf("clBuildProgram");
  for (int i = 0; i < 3; ++i)
    EXPECT_EQ("host", makePairDistances(settings)->deviceName());
  EXPECT_EQ(before + 1, callsOf("clBuildProgram"));
  failAlways("clBuildProgram", 0);
  try {
    makeOpenCLPairDistances("auto", 0);
    FAIL() << "no error";
  }
  catch (const DeviceError& error) {
    const std::string text = error.what();
    EXPECT_NE(std::string::npos, text.find("clBuildProgram with error -11")) << text;
    EXPECT_NE(std::string::npos, text.find("build")) << text;
  }
}

TEST_F(OpenCLFaults, OfAPlatformHideNoOther)
{
  const auto before = openCLDeviceNames();
  showBrokenPlatform(true);
  EXPECT_EQ(before, openCLDeviceNames());
  loseProgram(on("auto"));
  EXPECT_EQ(name_, makePairDistances(on("auto"))->deviceName());
  // where there is no other, it is told as what it is
  failAlways("clGetDeviceIDs", -6);
  loseProgram(on("auto"));
  try {
    makeOpenCLPairDistances("auto", 1);
    ADD_FAILURE() << "no error";
  }
  catch (const DeviceError& error) {
    const std::string text = error.what();
    for (const char* part :
         {"clGetPlatformInfo with error -32", "clGetDeviceIDs with error -6"})
      EXPECT_NE(std::string::npos, text.find(part)) << text;
    EXPECT_EQ(std::string::npos, text.find("install")) << text;
  }
  failAlways("clGetDeviceIDs", 0);
}

TEST_F(OpenCLFaults, DoNotComeOfLittleMemory)
{
  // in many dispatches as in one
  const Settings settings = on("auto");
  const auto asked = [&](Eigen::Index points) {
    loseProgram(settings);
    const long before = callsOf("clEnqueueNDRangeKernel");
    Evaluators evaluators(settings);
    evaluators.setClouds(points);
    const Answers answers = evaluators.ask(500);
    return std::make_pair(answers, callsOf("clEnqueueNDRangeKernel") - before);
  };
  const auto expected = asked(150);
  claimLargestBuffer(200000);
  const auto found = asked(150);
  EXPECT_EQ(expected.first.device, found.first.device);
  EXPECT_EQ(expected.first.bits, found.first.bits);
  EXPECT_GT(found.second, expected.second);
  // what does not fit at all is the host's, or an error
  claimLargestBuffer(20000);
  const auto too_large = asked(5000).first;
  EXPECT_EQ("host", too_large.device);
  loseProgram(settings);
  const auto evaluator = makeOpenCLPairDistances("auto", 1);
  const Points cloud = Points::Random(3, 6000);
  try {
    evaluator->setClouds(cloud, cloud);
    FAIL() << "no error";
  }
  catch (const DeviceError& error) {
    const std::string text = error.what();
    EXPECT_NE(std::string::npos, text.find("20000 bytes at most")) << text;
  }
}

} // namespace
