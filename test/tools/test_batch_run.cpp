/*
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * The program for many pairs: the same results however it gets to them.
 */

#include "own_folder.h"

#include <Eigen/Geometry>

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <algorithm>
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

namespace {

using JSON = nlohmann::json;

constexpr int PAIRS = 10;

/** Runs the program in a folder with some clouds and a list of pairs. */
class BatchRun : public kss_test::OwnFolder {
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

  /** Random points of a surface without any symmetry, a different one for each number. */
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

  /** The final files, whose bytes do not depend on anything but the run. */
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

  /** The program with a small search, which is the same everywhere. */
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

  /** The results of an undisturbed run in one thread. */
  std::string
  expected() const
  {
    const Outcome outcome =
        run(batch({"pairs.csv", "--out", "expected", "--threads", "1"}));
    EXPECT_EQ(0, outcome.status) << outcome.errors;
    return results("expected");
  }

  /** How often a journal says that each pair is done. */
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

  /** Wait for something, but not forever. */
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

  /** How often a journal has a text. */
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

TEST_F(BatchRun, ResultsAreThoseOfSingleRuns)
{
  write("guess.txt", "1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n");
  write("some.jsonl",
        "{\"source\": \"s0\", \"target\": \"t0\", \"name\": \"plain\"}\n"
        "{\"source\": \"s1\", \"target\": \"t1\", \"guess\": \"guess.txt\"}\n"
        "{\"source\": \"line\", \"target\": \"t0\"}\n");
  EXPECT_EQ(1, run(batch({"some.jsonl", "--out", "out", "--threads", "2"})).status);
  const std::vector<std::string> reports = lines("out/results.jsonl");
  const std::vector<std::string> table = lines("out/results.csv");
  ASSERT_EQ(3u, reports.size());
  ASSERT_EQ(4u, table.size());

  const std::vector<std::vector<std::string>> files = {
      {"s0", "t0"}, {"s1", "t1", "--guess", "guess.txt"}, {"line", "t0"}};
  for (std::size_t i = 0; i < files.size(); ++i) {
    std::vector<std::string> words =
        batch({"--threads", "1", "--report", "single.json"});
    words[0] = PCL_KSS_ICP_TOOL;
    words.insert(words.end(), files[i].begin(), files[i].end());
    EXPECT_EQ(i == 2 ? 1 : 0, run(words).status);
    JSON single = JSON::parse(content("single.json"));
    single.erase("seconds");
    JSON report = JSON::parse(reports[i]);
    EXPECT_EQ(i + 1, report["number"].get<std::size_t>());
    EXPECT_EQ(i == 2 ? "refused" : "registered", report["status"]);
    for (const char* more : {"number", "name", "status", "warnings"})
      report.erase(more);
    EXPECT_EQ(single, report);

    // and the numbers of the table are those of the report
    std::istringstream row(table[i + 1]);
    std::vector<std::string> fields;
    for (std::string field; std::getline(row, field, ',');)
      fields.push_back(field);
    ASSERT_LE(26u, fields.size());
    EXPECT_EQ(report["confidence"].get<double>(), std::stod(fields[5]));
    if (i == 2)
      continue;
    for (std::size_t k = 0; k < 16; ++k)
      EXPECT_EQ(report["transformation"][k / 4][k % 4].get<double>(),
                std::stod(fields[6 + k]));
    EXPECT_EQ(report["scale"].get<double>(), std::stod(fields[22]));
    EXPECT_EQ(report["overlap"][0].get<double>(), std::stod(fields[23]));
    EXPECT_EQ(report["overlap"][1].get<double>(), std::stod(fields[24]));
    EXPECT_EQ(report["fitness"].get<double>(), std::stod(fields[25]));
  }
}

TEST_F(BatchRun, BadPairsCostALine)
{
  write("bad.csv", "source,target,guess\nnone,t0,\ns0,short.off,\nempty,t0,\ns0,t0,\n"
                   "s1,t1,line\nline,line,\n");
  const Outcome outcome = run(batch({"bad.csv", "--out", "a/new/folder"}));
  EXPECT_EQ(1, outcome.status);
  EXPECT_EQ("", outcome.errors);
  EXPECT_NE(
      std::string::npos,
      outcome.output.find("6 pairs: 1 registered, 0 ambiguous, 1 refused, 4 failed"))
      << outcome.output;
  const std::vector<std::string> table = lines("a/new/folder/results.csv");
  ASSERT_EQ(7u, table.size());
  const std::vector<std::string> starts = {
      "1,,none,t0,failed,,",     "2,,s0,short.off,failed,,", "3,,empty,t0,failed,,",
      "4,,s0,t0,registered,0.9", "5,,s1,t1,failed,,",        "6,,line,line,refused,"};
  const std::vector<std::string> reasons = {
      "No such file", "short.off: ", "is empty", "", "holds no transformation", ""};
  const auto commas = [](const std::string& row) {
    return std::count(row.begin(), row.end(), ',');
  };
  for (std::size_t i = 0; i < starts.size(); ++i) {
    EXPECT_EQ(0u, table[i + 1].find(starts[i])) << table[i + 1];
    EXPECT_NE(std::string::npos, table[i + 1].find(reasons[i])) << table[i + 1];
    EXPECT_LE(commas(table[0]), commas(table[i + 1]));
  }
  EXPECT_EQ(7u, lines("a/new/folder/times.csv").size());
}

TEST_F(BatchRun, AnyNumberOfThreadsGivesTheSameBytes)
{
  const std::string one = expected();
  EXPECT_EQ(0, run(batch({"pairs.csv", "--out", "out", "--threads", "3"})).status);
  EXPECT_EQ(one, results("out"));
  EXPECT_EQ(0, run(batch({"pairs.csv", "--out", "out"})).status)
      << "nothing left to do";
  EXPECT_EQ(one, results("out"));
  EXPECT_EQ(std::vector<int>(PAIRS, 1), timesDone("out"));
}

TEST_F(BatchRun, KilledRunsGoOn)
{
  const std::string whole = expected();
  std::mt19937 random(3);
  // some pairs farther each time, which keeps those that were running from suspicion
  for (std::size_t number = 2; number < PAIRS; number += 2) {
    const pid_t child =
        start(batch({"pairs.csv", "--out", "out", "--threads", "2", "--quiet"}));
    EXPECT_TRUE(waitFor([&] { return timesInJournal("out", "{\"done\":") >= number; }));
    std::this_thread::sleep_for(std::chrono::milliseconds(random() % 50));
    kill(child, SIGKILL);
    const Outcome outcome = finish(child);
    EXPECT_EQ("", outcome.errors);
    EXPECT_EQ(-1, outcome.status);
    EXPECT_FALSE(std::filesystem::exists(path("out/results.csv")));
  }
  EXPECT_EQ(0, run(batch({"pairs.csv", "--out", "out", "--threads", "2"})).status);
  EXPECT_EQ(std::vector<int>(PAIRS, 1), timesDone("out"));
  EXPECT_EQ(whole, results("out"));
}

TEST_F(BatchRun, SignalsEndItCleanly)
{
  const std::string whole = expected();
  for (int times = 0; times < 4; ++times) {
    const std::size_t before = timesInJournal("out", "{\"begun\":");
    const pid_t child = start(batch({"pairs.csv", "--out", "out", "--threads", "1"}));
    EXPECT_TRUE(waitFor([&] { return timesInJournal("out", "{\"begun\":") > before; }));
    kill(child, SIGTERM);
    const Outcome outcome = finish(child);
    EXPECT_EQ(143, outcome.status);
    EXPECT_NE(std::string::npos,
              outcome.errors.find("ended by SIGTERM\nwhat is done is "
                                  "kept; the same command goes on"))
        << outcome.errors;
  }
  EXPECT_EQ(0, run(batch({"pairs.csv", "--out", "out"})).status);
  EXPECT_EQ(whole, results("out")) << "no pair is suspected";
}

TEST_F(BatchRun, PairsThatEndItAreNotTriedForever)
{
  for (int times = 0; times < 3; ++times) {
    const std::size_t before = timesInJournal("out", "{\"begun\":1}");
    const pid_t child = start(batch({"pairs.csv", "--out", "out", "--threads", "1"}));
    EXPECT_TRUE(
        waitFor([&] { return timesInJournal("out", "{\"begun\":1}") > before; }));
    kill(child, SIGKILL);
    EXPECT_EQ(-1, finish(child).status);
  }
  EXPECT_EQ(1, run(batch({"pairs.csv", "--out", "out"})).status);
  const std::vector<std::string> table = lines("out/results.csv");
  ASSERT_EQ(PAIRS + 1u, table.size());
  EXPECT_EQ(0u, table[1].find("1,pair 0,s0,t0,failed,,")) << table[1];
  EXPECT_NE(std::string::npos, table[1].find("in 3 starts")) << table[1];
  for (std::size_t i = 2; i < table.size(); ++i)
    EXPECT_NE(std::string::npos, table[i].find(",registered,")) << table[i];
}

TEST_F(BatchRun, WhatHasChangedIsNotMixed)
{
  const std::string whole = expected();
  expectError(run(batch({"pairs.csv", "--out", "expected", "--samples", "50"})),
              "is of a run with other settings; --restart begins anew");
  const std::string manifest = content("pairs.csv");
  write("pairs.csv", manifest + "more,s0,t1\n");
  expectError(run(batch({"pairs.csv", "--out", "expected"})),
              "is of a run with another manifest");
  write("pairs.csv", manifest);
  EXPECT_EQ(0, run(batch({"pairs.csv", "--out", "expected"})).status);

  write("t2", content("t3"));
  expectError(run(batch({"pairs.csv", "--out", "expected"})),
              "the files of pair 3 (s2, t2) have changed");
  run(batch({"pairs.csv", "--out", "expected", "--restart"}));
  EXPECT_NE(whole, results("expected"));
}

TEST_F(BatchRun, FullDisksAreTold)
{
  file_size_limit_ = 20000;
  expectError(run(batch({"pairs.csv", "--out", "out"})), "cannot be written");
  file_size_limit_ = 0;
  EXPECT_EQ(0, run(batch({"pairs.csv", "--out", "out"})).status);
  EXPECT_EQ(expected(), results("out"));
}

TEST_F(BatchRun, WrongCommandLines)
{
  expectError(run(batch({"pairs.csv"})), "needs --out DIR");
  expectError(run(batch({"--out", "out"})), "needs one MANIFEST");
  expectError(run(batch({"none.csv", "--out", "out"})), "none.csv: No such file");
  expectError(run(batch({"pairs.csv", "--out", "s0"})), "s0: cannot be made a folder");
  expectError(run(batch({"pairs.csv", "--out", "out", "--energy", "none"})),
              "--energy");
  EXPECT_FALSE(std::filesystem::exists(path("out")));
  EXPECT_EQ(0, run(batch({"--version"})).status);
}

/** Under mpirun, where there is one. */
class BatchRanks : public BatchRun {
protected:
  void
  SetUp() override
  {
    if (std::string(PCL_KSS_ICP_MPIRUN).empty())
      GTEST_SKIP() << "Built without MPI";
    BatchRun::SetUp();
    setenv("OMPI_ALLOW_RUN_AS_ROOT", "1", 1);
    setenv("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1", 1);
    setenv("PCL_KSS_ICP_RANK_PATIENCE", "2", 1);
  }

  static std::vector<std::string>
  ranks(int number, std::vector<std::string> more)
  {
    std::vector<std::string> words = {PCL_KSS_ICP_MPIRUN, "--oversubscribe", "-n",
                                      std::to_string(number)};
    for (const auto& word : {"--threads", "1", "--quiet"})
      more.push_back(word);
    more = batch(more);
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }

  /** The process of a rank below a process; 0: there is none yet. */
  static pid_t
  processOf(pid_t parent, int rank)
  {
    std::ifstream children("/proc/" + std::to_string(parent) + "/task/" +
                           std::to_string(parent) + "/children");
    for (pid_t child; children >> child;) {
      std::ostringstream variables;
      variables << std::ifstream("/proc/" + std::to_string(child) + "/environ").rdbuf();
      if (variables.str().find("OMPI_COMM_WORLD_RANK=" + std::to_string(rank) + '\0') !=
          std::string::npos)
        return child;
    }
    return 0;
  }
};

TEST_F(BatchRanks, AnyNumberGivesTheSameBytes)
{
  const std::string alone = expected();
  for (const int number : {1, 2, 3}) {
    const std::string folder = "out" + std::to_string(number);
    const Outcome outcome = run(ranks(number, {"pairs.csv", "--out", folder}));
    EXPECT_EQ(0, outcome.status) << outcome.errors;
    EXPECT_EQ(alone, results(folder));
    EXPECT_EQ(std::vector<int>(PAIRS, 1), timesDone(folder));
  }
}

TEST_F(BatchRanks, MistakesEndAllOfThem)
{
  const Outcome outcome = run(ranks(2, {"none.csv", "--out", "out"}));
  EXPECT_EQ(2, outcome.status);
  EXPECT_NE(std::string::npos, outcome.errors.find("none.csv: No such file"));
}

TEST_F(BatchRanks, KilledOnesEndAllWhichGoesOn)
{
  const std::string alone = expected();
  const pid_t child = start(ranks(2, {"pairs.csv", "--out", "out"}));
  EXPECT_TRUE(waitFor([&] { return timesInJournal("out", "{\"done\":") > 0; }));
  kill(processOf(child, 1), SIGKILL);
  EXPECT_NE(0, finish(child).status);
  EXPECT_EQ(0, run(ranks(2, {"pairs.csv", "--out", "out"})).status);
  EXPECT_EQ(alone, results("out"));
  EXPECT_EQ(std::vector<int>(PAIRS, 1), timesDone("out"));
}

TEST_F(BatchRanks, OthersDoTheWorkOfKilledOnes)
{
  const std::string alone = expected();
  std::vector<std::string> words = ranks(3, {"pairs.csv", "--out", "out"});
  words.insert(words.begin() + 1, "--enable-recovery");
  const pid_t child = start(words);
  EXPECT_TRUE(waitFor([&] { return timesInJournal("out", "{\"begun\":5}") > 0; }));
  kill(processOf(child, 1), SIGKILL);
  const Outcome outcome = finish(child);
  EXPECT_NE(std::string::npos, outcome.errors.find("rank 1 is not heard of any more"))
      << outcome.errors;
  EXPECT_EQ(alone, results("out"));
  EXPECT_EQ(std::vector<int>(PAIRS, 1), timesDone("out"));
}

} // namespace
