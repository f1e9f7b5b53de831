/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "own_folder.h"

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>

namespace kss_test {

/** \brief Runs a program in a folder of the test. */
class ProgramRun : public OwnFolder {
protected:
  struct Outcome {
    int status; ///< -1 where a signal ended it
    std::string output, errors;
  };

  std::string
  content(const std::string& name) const
  {
    std::ostringstream text;
    text << std::ifstream(path(name), std::ios::binary).rdbuf();
    return text.str();
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

  /** \brief A program as so many ranks of mpirun, which may be root's. */
  static std::vector<std::string>
  asRanks(int number, const std::vector<std::string>& program)
  {
    setenv("OMPI_ALLOW_RUN_AS_ROOT", "1", 1);
    setenv("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1", 1);
    std::vector<std::string> words = {PCL_KSS_ICP_MPIRUN, "--oversubscribe", "-n",
                                      std::to_string(number)};
    words.insert(words.end(), program.begin(), program.end());
    return words;
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
