/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "own_folder.h"
#include "tool_path.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <random>
#include <set>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace kss_test {

/** \brief Runs the tool in a folder with a cloud, for a limited time. */
class HostileRun : public OwnFolder {
protected:
  /** \brief How a run of the tool ended, and what it took. */
  struct Outcome {
    /** \brief The exit status; -1 where a signal ended it. */
    int status;
    std::string errors;
    double seconds;
    long megabytes;
  };

  void
  SetUp() override
  {
    write("cloud.xyz", blob(1500));
  }

  /** \brief Rows of points of a surface without any symmetry. */
  static std::string
  blob(int points)
  {
    std::mt19937 random(1);
    std::ostringstream rows;
    for (int i = 0; i < points; ++i) {
      const double z = 2.0 * (random() / 4294967296.0) - 1.0;
      const double angle = 2.0 * M_PI * (random() / 4294967296.0);
      const double radius = std::sqrt(1.0 - z * z);
      const double x = radius * std::cos(angle), y = radius * std::sin(angle);
      const double far = 1.0 + 0.5 * x * y + 0.4 * z * z * z + 0.3 * x;
      rows << x * far << ' ' << y * far << ' ' << z * far << '\n';
    }
    return rows.str();
  }

  /** \brief Rows of points of an open crate. */
  static std::string
  crate(int points)
  {
    std::mt19937 random(2);
    std::ostringstream rows;
    for (int i = 0; i < points; ++i) {
      double at[] = {random() / 4294967296.0, random() / 4294967296.0,
                     random() / 4294967296.0};
      const int side = i % 5;
      at[side % 3] = side / 3;
      rows << at[0] << ' ' << 2.0 * at[1] << ' ' << 0.6 * at[2] << '\n';
    }
    return rows.str();
  }

  /** \brief Start the tool in the directory with its files. */
  pid_t
  start(std::vector<std::string> arguments) const
  {
    arguments.insert(arguments.begin(),
                     {toolPath(), "--device", "host", "--threads", "1"});
    std::vector<char*> words;
    for (auto& argument : arguments)
      words.push_back(argument.data());
    words.push_back(nullptr);
    const pid_t child = fork();
    if (child != 0)
      return child;
    rlimit no_core = {0, 0};
    setrlimit(RLIMIT_CORE, &no_core);
    if (file_size_limit_ > 0) {
      rlimit limit = {file_size_limit_, file_size_limit_};
      setrlimit(RLIMIT_FSIZE, &limit);
    }
    const int errors = open(path("errors").c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    const int nothing = open("/dev/null", O_WRONLY);
    if (chdir(directory_.c_str()) != 0 || dup2(errors, 2) < 0 || dup2(nothing, 1) < 0)
      _exit(99);
    execv(words[0], words.data());
    _exit(99);
  }

  Outcome
  finish(pid_t child) const
  {
    constexpr int deadline = 20;
    std::atomic<bool> done{false};
    std::thread killer([&] {
      for (int i = 0; i < deadline * 100 && !done; ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
      if (!done)
        kill(child, SIGKILL);
    });
    int status = 0;
    rusage usage = {};
    wait4(child, &status, 0, &usage);
    done = true;
    killer.join();
    std::ostringstream errors;
    errors << std::ifstream(path("errors")).rdbuf();
    std::filesystem::remove(path("errors"));
    // the CPU's time, for other work on the machine does not lengthen it
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, errors.str(),
            usage.ru_utime.tv_sec + usage.ru_stime.tv_sec +
                1e-6 * (usage.ru_utime.tv_usec + usage.ru_stime.tv_usec),
            usage.ru_maxrss / 1024};
  }

  Outcome
  run(const std::vector<std::string>& arguments) const
  {
    return finish(start(arguments));
  }

  /** \brief That the tool ends with one of the statuses, soon, with little memory, and
   * with one sentence. */
  static void
  expectOneSentence(const Outcome& outcome, const std::set<int>& statuses)
  {
    EXPECT_EQ(1u, statuses.count(outcome.status)) << outcome.status << outcome.errors;
    EXPECT_EQ(0u, outcome.errors.find("pcl_kss_icp: ")) << outcome.errors;
    // and what to try where nothing was registered, in lines of its own
    const std::string sentence =
        outcome.errors.substr(0, outcome.errors.find('\n') + 1);
    const std::string advice = outcome.errors.substr(sentence.size());
    EXPECT_FALSE(sentence.empty()) << outcome.errors;
    EXPECT_TRUE(advice.empty() || outcome.status == 1) << outcome.errors;
    EXPECT_EQ(std::string::npos, advice.find("pcl_kss_icp: ")) << outcome.errors;
    EXPECT_LT(sentence.size(), 600u) << outcome.errors;
    EXPECT_LT(advice.size(), 500u) << outcome.errors;
    EXPECT_LT(outcome.seconds, 1.0);
    EXPECT_LT(outcome.megabytes, 500);
  }

  rlim_t file_size_limit_ = 0;
};

} // namespace kss_test
