/*
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * The program for many pairs: the same results however it gets to them.
 */

#include "batch_run.h"

#include <algorithm>

namespace {

using namespace kss_test;

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

TEST_F(BatchRun, PairsThatFailedAreTriedAgain)
{
  write("two.csv", "source,target\ns0,t0\nlate,t0\n");
  EXPECT_EQ(1, run(batch({"two.csv", "--out", "out"})).status);
  EXPECT_NE(std::string::npos, lines("out/results.csv").at(2).find("late: No such"));
  write("late", content("s0"));
  const Outcome outcome = run(batch({"two.csv", "--out", "out"}));
  EXPECT_EQ(0, outcome.status) << outcome.errors;
  EXPECT_NE(std::string::npos, outcome.errors.find("1 of 2 pairs are done already"))
      << outcome.errors;
  EXPECT_EQ(0u, lines("out/results.csv").at(2).find("2,,late,t0,registered,0.9"));
}

TEST_F(BatchRun, DamagedLinesOfTheJournalAreDoneAgain)
{
  const std::string whole = expected();
  std::string journal = content("expected/journal.jsonl");
  journal.replace(journal.find("{\"done\":2") + 20, 5, std::string(5, '\0'));
  write("expected/journal.jsonl", journal);
  const Outcome outcome = run(batch({"pairs.csv", "--out", "expected"}));
  EXPECT_EQ(0, outcome.status) << outcome.errors;
  EXPECT_NE(std::string::npos,
            outcome.errors.find("warning: 1 line of the journal cannot be read"))
      << outcome.errors;
  EXPECT_EQ(whole, results("expected"));
}

TEST_F(BatchRun, ListsAreNotReplacedByResults)
{
  const std::string manifest = content("pairs.csv");
  for (const char* name : {"results.csv", "journal.jsonl"}) {
    write(name, manifest);
    expectError(run(batch({name, "--out", ".", "--restart"})), "would replace");
    EXPECT_EQ(manifest, content(name));
  }
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

} // namespace
