/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "evaluation_models.h"

#include <nlohmann/json.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <set>
#include <vector>

#include <sys/wait.h>

/** \file
 * Runs the evaluation, whose path is the last argument of this program.
 */

namespace {

using namespace kss_test;
using Record = nlohmann::ordered_json;
namespace fs = std::filesystem;

std::string program_path;

struct Outcome {
  int status;
  std::string output, errors;
};

const std::vector<std::string> bad_files = {"broken.off", "empty.off", "empty.ply",
                                            "notes.txt"};

/** What all tests have runs of. */
const char* const what = " --methods KSS-ICP,ICP --tables similarity,deleted"
                         " --points 2000 --time-limit 60";

std::vector<std::string>
linesOf(const std::string& text)
{
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);)
    lines.push_back(line);
  return lines;
}

/** In the order of their text, since runs end in any order; without what they cost. */
std::vector<std::string>
resultsOf(const std::string& runs)
{
  std::vector<std::string> results;
  for (const auto& line : linesOf(runs)) {
    Record record = Record::parse(line);
    for (const char* cost : {"cpu_s", "wall_s", "peak_mb"})
      EXPECT_EQ(1u, record.erase(cost)) << line;
    results.push_back(record.dump());
  }
  std::sort(results.begin(), results.end());
  return results;
}

/** The models, and one evaluation that the tests look at. */
class EvaluationRun : public ::testing::Test {
protected:
  static void
  SetUpTestSuite()
  {
    folder = std::make_unique<Folder>("EvaluationRun");
    folder->write("models/creature.off", offOf(creature()));
    folder->write("models/more/lump.obj", objOf(lump()));
    folder->write("models/lump.pcd", pcdOf(sampled(lump(), 6000, 1)));
    folder->write("models/broken.off", "OFF\n8 6 0\n0 0 0\n1 0 0\n");
    folder->write("models/empty.off", "OFF\n0 0 0\n");
    folder->write("models/empty.ply", "");
    folder->write("models/notes.txt", "These are models.\n");
    first = evaluate("models", "first", what);
  }

  static void
  TearDownTestSuite()
  {
    folder.reset();
  }

  void
  SetUp() override
  {
    ASSERT_EQ(0, first.status) << first.errors;
  }

  /** Run the program in the folder. */
  static Outcome
  run(const std::string& arguments)
  {
    const std::string command = "cd '" + folder->path() + "' && '" + program_path +
                                "' " + arguments + " > output 2> errors";
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1,
            textOf(folder->path("output")), textOf(folder->path("errors"))};
  }

  static Outcome
  evaluate(const std::string& models,
           const std::string& out,
           const std::string& arguments)
  {
    return run(models + " --out " + out + arguments);
  }

  static std::string
  content(const std::string& name)
  {
    return textOf(folder->path(name));
  }

  /** A folder with the same results. */
  static void
  copyFirst(const std::string& out)
  {
    fs::copy(folder->path("first"), folder->path(out), fs::copy_options::recursive);
  }

  /** One clear sentence, beside what is said about files passed over. */
  static void
  expectRefusal(const Outcome& outcome,
                int status,
                const std::vector<std::string>& words)
  {
    EXPECT_EQ(status, outcome.status) << outcome.errors;
    EXPECT_EQ("", outcome.output);
    auto lines = linesOf(outcome.errors);
    lines.erase(std::remove_if(lines.begin(), lines.end(),
                               [](const std::string& line) {
                                 return line.find("; passed over") != std::string::npos;
                               }),
                lines.end());
    ASSERT_EQ(1u, lines.size()) << outcome.errors;
    EXPECT_EQ(0u, lines[0].find("pcl_kss_icp_evaluate: ")) << lines[0];
    for (const auto& word : words)
      EXPECT_NE(std::string::npos, lines[0].find(word)) << word << " in " << lines[0];
  }

  static std::unique_ptr<Folder> folder;
  static Outcome first;
};

std::unique_ptr<Folder> EvaluationRun::folder;
Outcome EvaluationRun::first;

} // namespace

TEST_F(EvaluationRun, TakesTheModelsThatCanBeRead)
{
  EXPECT_NE(std::string::npos, first.errors.find("3 of 3 models")) << first.errors;
}

TEST_F(EvaluationRun, NamesEachFileThatIsPassedOver)
{
  const auto lines = linesOf(first.errors);
  for (const auto& file : bad_files)
    EXPECT_EQ(1, std::count_if(lines.begin(), lines.end(),
                               [&](const std::string& line) {
                                 return line.find(file) != std::string::npos;
                               }))
        << file << " in " << first.errors;
  EXPECT_EQ(4, std::count_if(lines.begin(), lines.end(),
                             [](const std::string& line) {
                               return line.find("; passed over") != std::string::npos;
                             }))
      << first.errors;
  const auto skipped = Record::parse(content("first/run.json")).at("skipped");
  EXPECT_EQ(4u, skipped.size());
}

TEST_F(EvaluationRun, LogsEveryRun)
{
  std::set<std::string> keys;
  for (const auto& line : linesOf(content("first/runs.jsonl"))) {
    const Record record = Record::parse(line);
    std::string key;
    for (const char* part :
         {"model", "condition", "repetition", "method", "scale_given"})
      key += record.at(part).dump() + ' ';
    keys.insert(key);
    EXPECT_EQ("ok", record.at("status")) << line;
    EXPECT_EQ(16u, record.at("pose").size()) << line;
    for (const char* measured :
         {"mse", "rmse", "mae", "mse_r", "rmse_r", "mae_r", "rotation_deg",
          "translation", "scale", "tre", "cpu_s", "wall_s", "peak_mb"})
      EXPECT_GE(record.at(measured).get<double>(), 0.0) << measured << line;
  }
  std::set<std::string> expected;
  for (const char* model : {"\"creature\"", "\"lump\"", "\"more/lump\""})
    for (const char* condition : {"\"similarity\"", "\"deleted-0.3\""})
      for (const char* method : {"\"KSS-ICP\"", "\"ICP\""})
        for (const char* scale_given : {"false", "true"})
          expected.insert(std::string(model) + ' ' + condition + " 0 " + method + ' ' +
                          scale_given + ' ');
  EXPECT_EQ(expected, keys);
  EXPECT_EQ(expected.size(), linesOf(content("first/runs.jsonl")).size());
}

TEST_F(EvaluationRun, SolvesAllByKSSICP)
{
  int runs = 0;
  for (const auto& line : linesOf(content("first/runs.jsonl"))) {
    const Record record = Record::parse(line);
    if (record.at("method") != "KSS-ICP")
      continue;
    ++runs;
    EXPECT_EQ(true, record.at("solved")) << line;
    EXPECT_LT(record.at("rotation_deg").get<double>(), 5.0) << line;
    EXPECT_LT(record.at("rmse").get<double>(), 0.03) << line;
  }
  EXPECT_EQ(12, runs);
}

TEST_F(EvaluationRun, IcpDoesNotFindTheScale)
{
  for (const auto& line : linesOf(content("first/runs.jsonl"))) {
    const Record record = Record::parse(line);
    if (record.at("method") != "ICP")
      continue;
    // more than 30 degrees about each axis are too much for it
    EXPECT_EQ(false, record.at("solved")) << line;
    EXPECT_EQ(record.at("scale_given").get<bool>(),
              record.at("scale").get<double>() < 1e-5)
        << line;
  }
  for (const auto& method : Record::parse(content("first/run.json")).at("methods"))
    EXPECT_EQ(method.at("name") != "ICP", method.at("estimates_scale"));
}

TEST_F(EvaluationRun, WritesAReport)
{
  const std::string report = content("first/report.md");
  EXPECT_NE(std::string::npos, report.find("KSS-ICP"));
  // marked: it cannot estimate the scale
  EXPECT_NE(std::string::npos, report.find("ICP †"));
  EXPECT_EQ(std::string::npos, report.find("KSS-ICP †"));
  EXPECT_FALSE(fs::is_empty(folder->path("first/tables")));
}

TEST_F(EvaluationRun, WritesTheWorstCases)
{
  int cases = 0;
  for (const auto& entry : fs::directory_iterator(folder->path("first/worst"))) {
    ++cases;
    const auto meta = Record::parse(textOf(entry.path() / "meta.json"));
    EXPECT_EQ("KSS-ICP", meta.at("method"));
    EXPECT_EQ(16u, meta.at("truth").size());
    EXPECT_EQ(16u, meta.at("pose").size());
    for (const char* cloud : {"source.ply", "target.ply"})
      EXPECT_GT(fs::file_size(entry.path() / cloud), 10000u);
  }
  EXPECT_EQ(6, cases);
}

TEST_F(EvaluationRun, GoesOnWhereItWas)
{
  copyFirst("again");
  const Outcome again = evaluate("models", "again", what);
  EXPECT_EQ(0, again.status) << again.errors;
  EXPECT_EQ(std::string::npos, again.errors.find("registrations done")) << again.errors;
  EXPECT_EQ(content("first/runs.jsonl"), content("again/runs.jsonl"));

  // stopped in the middle of a line, the third one from the end
  copyFirst("cut");
  const auto lines = linesOf(content("first/runs.jsonl"));
  std::string kept;
  for (std::size_t i = 0; i + 3 < lines.size(); ++i)
    kept += lines[i] + '\n';
  folder->write("cut/runs.jsonl", kept + lines[lines.size() - 3].substr(0, 100));
  const Outcome cut = evaluate("models", "cut", what);
  EXPECT_EQ(0, cut.status) << cut.errors;
  EXPECT_NE(std::string::npos, cut.errors.find("3 of 3 registrations done"))
      << cut.errors;
  EXPECT_EQ(0u, content("cut/runs.jsonl").find(kept));
  EXPECT_EQ(resultsOf(content("first/runs.jsonl")),
            resultsOf(content("cut/runs.jsonl")));
}

TEST_F(EvaluationRun, GivesTheSameResultsAgain)
{
  const Outcome second =
      evaluate("./models/", "second", std::string(what) + " --jobs 1");
  ASSERT_EQ(0, second.status) << second.errors;
  EXPECT_EQ(resultsOf(content("first/runs.jsonl")),
            resultsOf(content("second/runs.jsonl")));
}

TEST_F(EvaluationRun, RefusesOtherCasesInTheSameFolder)
{
  copyFirst("other");
  const std::string runs = content("other/runs.jsonl"),
                    about = content("other/run.json");
  expectRefusal(evaluate("models", "other", std::string(what) + " --seed 1"), 1,
                {"other/run.json", "another seed", "0 rather than 1", "--out"});
  EXPECT_EQ(runs, content("other/runs.jsonl"));
  EXPECT_EQ(about, content("other/run.json"));
}

TEST_F(EvaluationRun, GivesUpWhatTakesTooLong)
{
  const Outcome outcome =
      evaluate("models", "hasty",
               " --methods KSS-ICP --tables similarity --models 1 --time-limit 0.01");
  EXPECT_EQ(0, outcome.status) << outcome.errors;
  const auto lines = linesOf(content("hasty/runs.jsonl"));
  ASSERT_EQ(2u, lines.size());
  for (const auto& line : lines) {
    const Record record = Record::parse(line);
    EXPECT_EQ("timeout", record.at("status"));
    EXPECT_NE("", record.at("message"));
    EXPECT_EQ(false, record.at("solved"));
    EXPECT_EQ(false, record.at("claimed"));
    EXPECT_GT(record.at("mse").get<double>(), 0.0);
    EXPECT_FALSE(record.contains("cpu_s"));
  }
}

TEST_F(EvaluationRun, NeedsModels)
{
  folder->write("others/notes.txt", "no models\n");
  expectRefusal(evaluate("others", "out", ""), 1, {"others", "no model", "OFF, PLY"});
  expectRefusal(evaluate("missing", "out", ""), 1, {"missing", "no folder"});
  expectRefusal(evaluate("models/creature.off", "out", ""), 1,
                {"models/creature.off", "no folder"});
  EXPECT_FALSE(fs::exists(folder->path("out")));
}

TEST_F(EvaluationRun, NeedsAFolderThatItCanWrite)
{
  folder->write("file", "no folder\n");
  expectRefusal(evaluate("models", "file", what), 1, {"file"});
  expectRefusal(evaluate("models", "file/out", what), 1, {"file/out"});
  expectRefusal(evaluate("models", "/proc/out", what), 1, {"/proc/out"});
}

TEST_F(EvaluationRun, SaysWhatIsWrongWithTheCommandLine)
{
  expectRefusal(evaluate("models", "out", " --methods KSS-ICP,Magic"), 1,
                {"no method Magic", "--list-methods"});
  expectRefusal(evaluate("models", "out", " --tables noise"), 2,
                {"no table noise", "similarity"});
  expectRefusal(evaluate("models", "out", " --deleted 30"), 2, {"--deleted", "share"});
  expectRefusal(run("models"), 2, {"--out"});
  EXPECT_FALSE(fs::exists(folder->path("out")));
}

int
main(int argc, char** argv)
{
  ::testing::InitGoogleTest(&argc, argv);
  if (argc != 2) {
    std::cerr << "usage: " << argv[0] << " PROGRAM\n";
    return 2;
  }
  program_path = std::filesystem::absolute(argv[1]).string();
  return RUN_ALL_TESTS();
}
