/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include <pcl/registration/kss/devices.h>

#include "evaluators/evaluator_choice.h"
#include "evaluators/look_ups.h"
#include "evaluators/pair_distances.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <string>

#include <unistd.h>

namespace {

using namespace pcl::kss;

TEST(Device, IsTheOneAskedFor)
{
  Settings settings;
  settings.device = "host";
  EXPECT_EQ("host", makePairDistances(settings)->deviceName());
  EXPECT_EQ("host", makeLookUps(settings)->deviceName());
  const auto names = openCLDeviceNames();
  if (names.empty())
    GTEST_SKIP() << "There is no OpenCL device on this machine.";
  for (const std::string& name : names) {
    settings.device = name;
    EXPECT_EQ(name, makePairDistances(settings)->deviceName());
    EXPECT_EQ(name, makeLookUps(settings)->deviceName());
    // part of a name will do
    settings.device = name.substr(1, 5);
    EXPECT_NO_THROW(makePairDistances(settings));
  }
  settings.device = "auto";
  const std::string found = makePairDistances(settings)->deviceName();
  EXPECT_EQ(1, std::count(names.begin(), names.end(), found));
}

TEST(Device, ThatDoesNotExistIsAnErrorThatListsThoseThatDo)
{
  Settings settings;
  settings.device = "Difference Engine";
  try {
    makePairDistances(settings);
    FAIL() << "no error";
  }
  catch (const DeviceError& error) {
    const std::string text = error.what();
    EXPECT_NE(std::string::npos, text.find("Difference Engine")) << text;
    for (const std::string& name : openCLDeviceNames())
      EXPECT_NE(std::string::npos, text.find(name)) << text;
  }
}

/** Run once more by ctest where PoCL cannot keep the programs that it builds. */
TEST(NoKernelCache, IsToldAsWhatItIs)
{
  const char* folder = std::getenv("POCL_CACHE_DIR");
  if (!folder || std::ofstream(std::string(folder) + "/some_file"))
    GTEST_SKIP() << "POCL_CACHE_DIR can be written.";
  if (access("/etc/OpenCL/vendors/pocl.icd", R_OK) != 0)
    GTEST_SKIP() << "PoCL is not installed.";
  try {
    makeOpenCLPairDistances("auto", 0);
    GTEST_SKIP() << "The device needs no such folder.";
  }
  catch (const DeviceError& error) {
    const std::string text = error.what();
    for (const char* part : {folder, "cannot be written", "Set POCL_CACHE_DIR"})
      EXPECT_NE(std::string::npos, text.find(part)) << text;
  }
  EXPECT_EQ("host", makePairDistances(Settings())->deviceName());
}

/** Run once more by ctest where the OpenCL loader is shown no driver. */
TEST(NoDevice, LeavesTheWorkToTheHost)
{
  if (!openCLDeviceNames().empty())
    GTEST_SKIP() << "There is an OpenCL device on this machine.";
  Settings settings;
  EXPECT_EQ("host", makePairDistances(settings)->deviceName());
  settings.device = "pthread";
  EXPECT_THROW(makePairDistances(settings), DeviceError);
  settings.search = Search::EXACT;
  EXPECT_THROW(makePairDistances(settings), DeviceError);
  EXPECT_THROW(makeOpenCLPairDistances("auto", 0), DeviceError);
  EXPECT_THROW(makeOpenCLLookUps("auto", 0, 96), DeviceError);
}

} // namespace
