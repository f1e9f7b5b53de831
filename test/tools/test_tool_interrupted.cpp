/*
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * The command line tool where it cannot end its work: it leaves nothing half done.
 */

#include "hostile_run.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <thread>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace {

using namespace kss_test;

TEST_F(HostileRun, FullDisksLeaveNothing)
{
  file_size_limit_ = 5000;
  for (const std::string name : {"a.pcd", "a.ply", "a.obj", "a.off", "a.xyz"}) {
    const Outcome outcome = run({"cloud.xyz", "cloud.xyz", name, "--points", "300"});
    EXPECT_EQ(2, outcome.status);
    EXPECT_NE(std::string::npos, outcome.errors.find(name + ": cannot be written"))
        << outcome.errors;
    EXPECT_EQ(std::set<std::string>{"cloud.xyz"}, files());
  }
  file_size_limit_ = 0;
  std::filesystem::create_symlink("/dev/full", path("full.pcd"));
  EXPECT_EQ(2, run({"cloud.xyz", "cloud.xyz", "full.pcd", "--points", "300"}).status);
}

/** Whether a process handles a signal. */
bool
handles(pid_t process, int signal)
{
  std::ifstream status("/proc/" + std::to_string(process) + "/status");
  for (std::string word; status >> word;)
    if (word == "SigCgt:" && status >> word)
      return std::stoull(word, nullptr, 16) >> (signal - 1) & 1;
  return false;
}

/** Wait for something, but not forever. */
template <typename Predicate>
bool
waitFor(Predicate predicate)
{
  for (int i = 0; i < 2000; ++i) {
    if (predicate())
      return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return false;
}

TEST_F(HostileRun, SignalsLeaveNothing)
{
  // a full pipe keeps the tool writing when its other file is written, but not in place
  ASSERT_EQ(0, mkfifo(path("pipe").c_str(), 0600));
  const int pipe = open(path("pipe").c_str(), O_RDWR | O_NONBLOCK);
  const std::string zeros(4096, '\0');
  while (::write(pipe, zeros.data(), zeros.size()) > 0) {
  }
  const auto has_part = [&] {
    const auto names = files();
    return std::any_of(names.begin(), names.end(), [](const std::string& name) {
      return name.find(".part") != std::string::npos;
    });
  };
  write("a.pcd", "old");
  const std::set<std::string> before = files();
  for (const int signal : {SIGINT, SIGTERM, SIGHUP})
    for (const bool is_writing : {false, true}) {
      SCOPED_TRACE(signal * 10 + is_writing);
      const pid_t child = start(
          {"cloud.xyz", "cloud.xyz", "a.pcd", "--points", "300", "--report", "pipe"});
      EXPECT_TRUE(waitFor(
          [&] { return handles(child, SIGHUP) && (!is_writing || has_part()); }));
      if (is_writing) // until it waits for the pipe
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
      kill(child, signal);
      const Outcome outcome = finish(child);
      EXPECT_EQ(128 + signal, outcome.status) << outcome.errors;
      EXPECT_EQ(0u, outcome.errors.find("pcl_kss_icp: ended by SIG")) << outcome.errors;
      EXPECT_EQ(before, files());
      EXPECT_EQ(3u, std::filesystem::file_size(path("a.pcd")));
    }
  close(pipe);
}

} // namespace
