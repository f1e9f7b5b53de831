/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "own_folder.h"

#include <Eigen/Geometry>

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <chrono>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace kss_test {

using JSON = nlohmann::json;

constexpr int PAIRS = 10;

/** \brief Runs the program in a folder with some clouds and a list of pairs. */
class BatchRun : public OwnFolder {
protected:
  struct Outcome {
    int status; ///< -1 where a signal ended it
    std::string output, errors;
  };

  void
  SetUp() override
  {
    std::string manifest = "name,source,target\n";
    for (int i = 0; i < PAIRS; ++i) {
      const std::string number = std::to_string(i);
      write("s" + number, lump(i, Eigen::Affine3d::Identity()));
      write("t" + number,
            lump(i, Eigen::Translation3d(i, 2, 3) *
                        Eigen::AngleAxisd(1.0 + i,
                                          Eigen::Vector3d(1, -2, 3).normalized())));
      manifest += "pair " + number + ",s" + number + ",t" + number + '\n';
    }
    write("pairs.csv", manifest);
    write("line", "0 0 0\n1 0 0\n2 0 0\n3 0 0\n");
    write("short.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n");
    write("empty", "");
  }

  /** \brief Random points of a surface without symmetry, another one each. */
  static std::string
  lump(int number, const Eigen::Affine3d& pose)
  {
    std::mt19937 random(1);
    const auto uniform = [&] { return random() / 4294967296.0; };
    std::ostringstream rows;
    rows.precision(17);
    for (int i = 0; i < 600; ++i) {
      const double z = 2.0 * uniform() - 1.0, angle = 2.0 * M_PI * uniform();
      const double x = std::sqrt(1.0 - z * z) * std::cos(angle);
      const double y = std::sqrt(1.0 - z * z) * std::sin(angle);
      const double far =
          1.0 + (0.5 + 0.02 * number) * x * y + 0.4 * z * z * z + 0.3 * x;
      rows << (pose * Eigen::Vector3d(x * far, y * far, z * far)).transpose() << '\n';
    }
    return rows.str();
  }

  std::string
  content(const std::string& name) const
  {
    std::ostringstream text;
    text << std::ifstream(path(name), std::ios::binary).rdbuf();
    return text.str();
  }

  /** \brief The final files, whose bytes do not depend on anything but the run. */
  std::string
  results(const std::string& folder) const
  {
    const std::string table = content(folder + "/results.csv");
    EXPECT_NE("", table);
    return table + content(folder + "/results.jsonl");
  }

  std::vector<std::string>
  lines(const std::string& name) const
  {
    std::istringstream text(content(name));
    std::vector<std::string> all;
    for (std::string line; std::getline(text, line);)
      all.push_back(line);
    return all;
  }

  pid_t
  start(std::vector<std::string> words) const
  {
    std::vector<char*> arguments;
    for (auto& word : words)
      arguments.push_back(word.data());
    arguments.push_back(nullptr);
    const pid_t child = fork();
    if (child != 0)
      return child;
    if (file_size_limit_ > 0) {
      const rlimit limit = {file_size_limit_, file_size_limit_};
      setrlimit(RLIMIT_FSIZE, &limit);
    }
    const int output = open(path("output").c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    const int errors = open(path("errors").c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    if (chdir(directory_.c_str()) != 0 || dup2(output, 1) < 0 || dup2(errors, 2) < 0)
      _exit(99);
    execv(arguments[0], arguments.data());
    _exit(99);
  }

  /** \brief The program with a small search, which is the same everywhere. */
  static std::vector<std::string>
  batch(std::vector<std::string> more)
  {
    more.insert(more.begin(),
                {PCL_KSS_ICP_BATCH, "--device", "host", "--points", "300", "--rigid"});
    return more;
  }

  Outcome
  finish(pid_t child) const
  {
    int status = 0;
    waitpid(child, &status, 0);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, content("output"),
            content("errors")};
  }

  Outcome
  run(const std::vector<std::string>& words) const
  {
    return finish(start(words));
  }

  /** \brief The results of an undisturbed run in one thread. */
  std::string
  expected() const
  {
    const Outcome outcome =
        run(batch({"pairs.csv", "--out", "expected", "--threads", "1"}));
    EXPECT_EQ(0, outcome.status) << outcome.errors;
    return results("expected");
  }

  /** \brief How often a journal says that each pair is done. */
  std::vector<int>
  timesDone(const std::string& folder) const
  {
    std::vector<int> times(PAIRS, 0);
    for (const std::string& text : lines(folder + "/journal.jsonl")) {
      const JSON line = JSON::parse(text);
      if (line.contains("done"))
        ++times.at(line["done"].get<std::size_t>() - 1);
    }
    return times;
  }

  /** \brief Wait for something, but not forever. */
  template <typename Predicate>
  static bool
  waitFor(Predicate predicate)
  {
    for (int i = 0; i < 30000; ++i) {
      if (predicate())
        return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return false;
  }

  /** \brief How often a journal has a text. */
  std::size_t
  timesInJournal(const std::string& folder, const std::string& text) const
  {
    const std::string journal = content(folder + "/journal.jsonl");
    std::size_t number = 0;
    for (std::size_t at = 0; (at = journal.find(text, at)) != journal.npos; ++at)
      ++number;
    return number;
  }

  static void
  expectError(const Outcome& outcome, const std::string& part)
  {
    EXPECT_EQ(2, outcome.status);
    EXPECT_NE(std::string::npos, outcome.errors.find(part)) << outcome.errors;
  }

  rlim_t file_size_limit_ = 0;
};

} // namespace kss_test
