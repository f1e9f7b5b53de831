/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "evaluation_cases.h"

#include "manifest.h"
#include "run_log.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

using namespace evaluation;
using namespace kss_test;

namespace {

Run
run(const std::string& method = "KSS-ICP")
{
  Run result;
  result.model = "bunny";
  result.condition.name = "gauss-0.66";
  result.repetition = 3;
  result.method.name = method;
  return result;
}

Record
recordOf(const Run& run, double mse)
{
  Record record = keyOf(run);
  record["status"] = "ok";
  record["mse"] = mse;
  return record;
}

class EvaluationLog : public FolderTest {
protected:
  std::string
  path() const
  {
    return folder.path("runs.jsonl");
  }
};

/** Runs to be told about, in a folder. */
class EvaluationManifest : public FolderTest {
protected:
  void
  write(const Options& options) const
  {
    Plan plan;
    plan.models = {{"bunny", "models/bunny.off", true}};
    plan.conditions = conditionsOf({"similarity", "gauss"}, options.protocol);
    Method method;
    method.name = "ICP";
    plan.methods = {{method, "peer", ""}};
    ModelFolder models;
    models.models = {{"bunny", "models/bunny.off", true},
                     {"cat", "models/cat.pcd", false}};
    models.skipped = {{"models/notes.txt", "is no model"}};
    writeManifest(path(), "pcl_kss_icp_evaluate models --out out", options, models,
                  plan);
  }

  /** What is said against these options; empty where they are taken. */
  std::string
  refusal(const Options& options) const
  {
    try {
      write(options);
    }
    catch (const std::runtime_error& problem) {
      return problem.what();
    }
    return "";
  }

  std::string
  path() const
  {
    return folder.path("run.json");
  }
};

} // namespace

TEST_F(EvaluationLog, FindsRunsAgain)
{
  {
    RunLog log(path());
    EXPECT_EQ(nullptr, log.find(run()));
    log.add(recordOf(run(), 0.1));
    log.add(recordOf(run("KSS-ICP (paper, host)"), 1.0 / 3.0));
    ASSERT_NE(nullptr, log.find(run()));
    EXPECT_EQ(0.1, log.find(run())->at("mse").get<double>());
  }
  const RunLog log(path());
  EXPECT_EQ(2u, log.records().size());
  ASSERT_NE(nullptr, log.find(run()));
  EXPECT_EQ(0.1, log.find(run())->at("mse").get<double>());
  EXPECT_EQ(1.0 / 3.0, log.find(run("KSS-ICP (paper, host)"))->at("mse").get<double>());
}

TEST_F(EvaluationLog, TellsRunsApart)
{
  RunLog log(path());
  log.add(recordOf(run(), 0.1));
  std::vector<evaluation::Run> others(5, run());
  others[0].model = "cat";
  others[1].condition.name = "gauss-0.33";
  others[2].repetition = 4;
  others[3].method.name = "ICP";
  others[4].scale_given = true;
  for (std::size_t i = 0; i < others.size(); ++i)
    EXPECT_EQ(nullptr, log.find(others[i])) << i;
}

TEST_F(EvaluationLog, IsWrittenAtOnce)
{
  RunLog log(path());
  log.add(recordOf(run(), 0.1));
  EXPECT_EQ(recordOf(run(), 0.1), Record::parse(textOf(path())));
}

TEST_F(EvaluationLog, StaysAsItIsWhenReopened)
{
  {
    RunLog log(path());
    log.add(recordOf(run(), 0.1));
    log.add(recordOf(run("ICP"), 0.7));
  }
  const std::string before = textOf(path());
  {
    const RunLog log(path());
  }
  EXPECT_EQ(before, textOf(path()));
}

TEST_F(EvaluationLog, DropsALastLineCutShort)
{
  {
    RunLog log(path());
    log.add(recordOf(run(), 0.1));
    log.add(recordOf(run("ICP"), 0.7));
  }
  const std::string whole = textOf(path());
  const std::string first = whole.substr(0, whole.find('\n') + 1);
  // within the line, before its last brace, and before the line's end
  for (const std::size_t missing : {whole.size() - first.size() - 1, std::size_t(20),
                                    std::size_t(2), std::size_t(1)}) {
    folder.write("runs.jsonl", whole.substr(0, whole.size() - missing));
    RunLog log(path());
    EXPECT_NE(nullptr, log.find(run()));
    EXPECT_EQ(missing == 1, log.find(run("ICP")) != nullptr);
    EXPECT_EQ(missing == 1 ? whole : first, textOf(path()));
    if (missing == 1)
      continue;
    log.add(recordOf(run("ICP"), 0.7));
    EXPECT_EQ(whole, textOf(path()));
  }
}

TEST_F(EvaluationLog, KeepsWhatItDoesNotUnderstand)
{
  {
    RunLog log(path());
    log.add(recordOf(run(), 0.5));
  }
  const std::string whole = textOf(path());
  for (const char* strange : {"17\n", "{\"condition\": \"density\"}\n", "{\"cond\n"}) {
    folder.write("runs.jsonl", strange + whole);
    try {
      RunLog log(path());
      FAIL() << strange;
    }
    catch (const std::runtime_error& problem) {
      EXPECT_EQ(0u, std::string(problem.what()).find(path() + ", line 1: "));
    }
    EXPECT_EQ(strange + whole, textOf(path()));
  }
}

TEST_F(EvaluationLog, TakesAnyText)
{
  {
    RunLog log(path());
    Record record = recordOf(run("a\n\"b\", c"), std::nan(""));
    record["message"] = "not UTF-8: \xff";
    log.add(record);
  }
  const RunLog log(path());
  ASSERT_NE(nullptr, log.find(run("a\n\"b\", c")));
  EXPECT_TRUE(log.find(run("a\n\"b\", c"))->at("mse").is_null());
}

TEST_F(EvaluationLog, NamesTheFileThatCannotBeWritten)
{
  try {
    RunLog log(folder.path("missing/runs.jsonl"));
    FAIL();
  }
  catch (const std::runtime_error& problem) {
    EXPECT_EQ(folder.path("missing/runs.jsonl") + ": cannot be written",
              problem.what());
  }
}

TEST_F(EvaluationManifest, TellsWhatIsEvaluated)
{
  Options options;
  options.protocol.seed = 7;
  options.time_limit = 12.0;
  write(options);
  const auto manifest = Record::parse(textOf(path()));
  EXPECT_EQ(7, manifest.at("seed"));
  EXPECT_EQ("pcl_kss_icp_evaluate models --out out", manifest.at("command"));
  EXPECT_EQ(1u, manifest.at("models").size());
  EXPECT_EQ("bunny", manifest.at("models")[0].at("name"));
  EXPECT_EQ("mesh", manifest.at("models")[0].at("kind"));
  EXPECT_EQ(2, manifest.at("readable_models"));
  EXPECT_EQ("models/notes.txt", manifest.at("skipped").at(0).at("file"));
  EXPECT_EQ("is no model", manifest.at("skipped").at(0).at("reason"));
  EXPECT_EQ(12.0, manifest.at("settings").at("time_limit_s"));
  EXPECT_EQ("ICP", manifest.at("methods").at(0).at("name"));
  EXPECT_EQ(false, manifest.at("methods").at(0).at("estimates_scale"));
  ASSERT_LT(2u, manifest.at("conditions").size());
  EXPECT_EQ("gauss-0.66", manifest.at("conditions")[2].at("name"));
  EXPECT_EQ("gauss", manifest.at("conditions")[2].at("table"));
  EXPECT_EQ(0.66, manifest.at("conditions")[2].at("parameter"));
}

TEST_F(EvaluationManifest, TakesMoreOfTheSameCases)
{
  Options options;
  options.protocol.seed = 7;
  options.protocol.smallest_scale = 0.3;
  options.protocol.largest_scale = 1.0;
  options.protocol.deleted = 1.0 / 3.0;
  write(options);
  EXPECT_EQ("", refusal(options));
  options.protocol.repetitions = 5;
  options.time_limit = 100.0;
  options.number_of_models = 0;
  options.jobs = 7;
  EXPECT_EQ("", refusal(options));
  EXPECT_EQ(5, Record::parse(textOf(path())).at("settings").at("repetitions"));
}

TEST_F(EvaluationManifest, RefusesOtherCases)
{
  write(Options());
  const std::string before = textOf(path());
  const std::vector<std::pair<std::string, std::function<void(Protocol&)>>> changes = {
      {"seed, 0 rather than 1", [](Protocol& p) { p.seed = 1; }},
      {"points, 10000 rather than 500", [](Protocol& p) { p.points = 500; }},
      {"rotation, \"axes\" rather than \"so3\"",
       [](Protocol& p) { p.rotations = Rotations::SO3; }},
      {"scale, [0.8,1.2] rather than [0.5,1.2]",
       [](Protocol& p) { p.smallest_scale = 0.5; }},
      {"scale, [0.8,1.2] rather than [0.8,2.0]",
       [](Protocol& p) { p.largest_scale = 2.0; }},
      {"deleted, 0.3 rather than 0.5", [](Protocol& p) { p.deleted = 0.5; }},
      {"resampling, \"gradient\" rather than \"wlop\"",
       [](Protocol& p) { p.resampling = Resampling::WLOP; }}};
  for (const auto& [text, change] : changes) {
    Options options;
    change(options.protocol);
    const std::string message = refusal(options);
    EXPECT_EQ(0u, message.find(path() + ": ")) << message;
    EXPECT_NE(std::string::npos, message.find(text)) << text << " in " << message;
    EXPECT_NE(std::string::npos, message.find("--out")) << message;
    EXPECT_EQ(before, textOf(path())) << text;
  }
  EXPECT_EQ("", refusal(Options()));
  Options other_folder;
  other_folder.models = "other models";
  EXPECT_NE(std::string::npos, refusal(other_folder).find("another models"));
}

TEST_F(EvaluationManifest, RefusesRunsThatNothingIsKnownAbout)
{
  folder.write("runs.jsonl", "{}\n");
  EXPECT_EQ(0u, refusal(Options()).find(path() + ": cannot be read"));
  folder.write("run.json", "{\"settings\": {\"seed\"");
  EXPECT_EQ(0u, refusal(Options()).find(path() + ": cannot be read"));
  EXPECT_EQ("{\"settings\": {\"seed\"", textOf(path()));
}

TEST_F(EvaluationManifest, NamesTheFileThatCannotBeWritten)
{
  std::filesystem::remove_all(folder.path());
  EXPECT_EQ(path() + ": cannot be written", refusal(Options()));
}
