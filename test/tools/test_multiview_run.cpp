/*
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * The program for many scans: the same results however it gets to them.
 */

#include "multiview/body.h"
#include "program_run.h"

#include <Eigen/LU>

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>

namespace {

using namespace kss_test;
using JSON = nlohmann::json;

/** A folder with three scans of a body, two of another one, and a file that is none. */
class MultiviewRun : public ProgramRun {
protected:
  void
  SetUp() override
  {
    for (const made_up::BodyScan& scan : made_up::scansOfTwoBodies(1500)) {
      T_scan_body_.push_back(scan.T_scan_body);
      points_.push_back(scan.points);
      scans_.push_back("scan_" + std::to_string(scans_.size() + 1) + ".ply");
      write(scans_.back(), asPLY(points_.back()));
    }
    write("broken.ply", "ply\nformat ascii 1.0\nelement vertex 3\n");
    all_ = scans_;
    all_.insert(all_.begin() + 3, "broken.ply");
    some_ = {scans_[0], "broken.ply", scans_[1], scans_[3]};
  }

  static std::string
  asPLY(const Eigen::Matrix3Xd& points)
  {
    std::ostringstream text;
    text.precision(17);
    text << "ply\nformat ascii 1.0\nelement vertex " << points.cols()
         << "\nproperty double x\nproperty double y\nproperty double z\nend_header\n"
         << points.transpose() << '\n';
    return text.str();
  }

  static std::vector<std::string>
  multiview(const std::vector<std::string>& scans,
            const std::string& folder,
            std::vector<std::string> more = {})
  {
    more.insert(more.begin(),
                {PCL_KSS_ICP_MULTIVIEW, "--device", "host", "--out", folder});
    more.insert(more.end(), scans.begin(), scans.end());
    return more;
  }

  /** The files whose bytes do not depend on anything but scans and settings. */
  std::string
  results(const std::string& folder) const
  {
    std::string all;
    for (const char* name : {"/poses.json", "/graph.json", "/pairs.csv"}) {
      EXPECT_NE("", content(folder + name)) << name;
      all += content(folder + name);
    }
    return all;
  }

  /** The results of an undisturbed run in one thread. */
  std::string
  expected() const
  {
    const Outcome outcome = run(multiview(some_, "expected", {"--threads", "1"}));
    EXPECT_EQ(1, outcome.status) << outcome.errors;
    return results("expected");
  }

  JSON
  poses(const std::string& folder) const
  {
    return JSON::parse(content(folder + "/poses.json"));
  }

  static Eigen::Matrix4d
  matrixOf(const JSON& rows)
  {
    Eigen::Matrix4d matrix;
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j)
        matrix(i, j) = rows[i][j];
    return matrix;
  }

  /** How far the points of a scan are off, at most, in the frame of the first scan of
   * its group. Both have a number here, and one among the results. */
  double
  errorOf(const JSON& poses,
          std::size_t scan,
          std::size_t scan_there,
          std::size_t first,
          std::size_t first_there) const
  {
    const Eigen::Matrix4d found =
        matrixOf(poses["scans"][first_there]["transformation"]).inverse() *
        matrixOf(poses["scans"][scan_there]["transformation"]);
    const Eigen::Matrix4d truth = T_scan_body_[first] * T_scan_body_[scan].inverse();
    return ((found - truth) * points_[scan].colwise().homogeneous())
        .colwise()
        .norm()
        .maxCoeff();
  }

  /** How many answers a journal has. */
  std::size_t
  answersIn(const std::string& folder) const
  {
    const std::string journal = content(folder + "/journal.txt");
    const std::size_t lines = std::count(journal.begin(), journal.end(), '\n');
    return lines == 0 ? 0 : lines - 1; // the first one says what it is of
  }

  /** Start the program, and kill it when it has so many answers. */
  void
  killWhenThereAre(std::size_t answers, const std::vector<std::string>& words) const
  {
    const pid_t child = start(words);
    EXPECT_TRUE(waitFor([&] { return answersIn("out") >= answers; }));
    kill(child, SIGKILL);
    EXPECT_EQ(-1, finish(child).status);
  }

  std::vector<Eigen::Matrix4d> T_scan_body_;
  std::vector<Eigen::Matrix3Xd> points_;
  std::vector<std::string> scans_, all_, some_; ///< the latter with the broken one
};

bool
has(const std::string& text, const std::string& part)
{
  return text.find(part) != std::string::npos;
}

TEST_F(MultiviewRun, FindsGroupsAndPoses)
{
  const Outcome outcome = run(multiview(all_, "out"));
  EXPECT_EQ(1, outcome.status) << outcome.errors;
  EXPECT_TRUE(has(outcome.output, "6 scans: 5 in 2 groups, 1 could not be used"))
      << outcome.output;
  const JSON found = poses("out");
  ASSERT_EQ(JSON::parse("[[1, 2, 3], [5, 6], [4]]"),
            JSON({found["groups"][0]["scans"], found["groups"][1]["scans"],
                  found["groups"][2]["scans"]}));
  EXPECT_LT(errorOf(found, 1, 1, 0, 0), 0.05);
  EXPECT_LT(errorOf(found, 2, 2, 0, 0), 0.05);
  EXPECT_LT(errorOf(found, 4, 5, 3, 4), 0.05);
  EXPECT_TRUE(found["complete"].get<bool>());
  EXPECT_TRUE(found["scans"][3]["transformation"].is_null());
  EXPECT_TRUE(has(found["scans"][3]["reason"].get<std::string>(), "broken.ply"));
  EXPECT_TRUE(has(content("out/merged_1.ply"), "element vertex 4500\n"));
  EXPECT_TRUE(has(content("out/merged_2.ply"), "element vertex 3000\n"));
  EXPECT_TRUE(has(content("out/index.html"), "6 scans: 5 in 2 groups"));
  EXPECT_FALSE(std::filesystem::exists(path("out/journal.txt")));
}

TEST_F(MultiviewRun, OneGroupIsASuccess)
{
  const Outcome outcome = run(multiview({scans_[3], scans_[4]}, "out", {"--quiet"}));
  EXPECT_EQ(0, outcome.status);
  EXPECT_EQ("", outcome.output + outcome.errors);
  EXPECT_LT(errorOf(poses("out"), 4, 1, 3, 0), 0.05);
}

TEST_F(MultiviewRun, AnyNumberOfThreadsGivesTheSameBytes)
{
  const std::string one = expected();
  EXPECT_EQ(1, run(multiview(some_, "out", {"--threads", "3"})).status);
  EXPECT_EQ(one, results("out"));
  EXPECT_EQ(1, run(multiview(some_, "out", {"--memory", "10"})).status);
  EXPECT_EQ(one, results("out"));
}

TEST_F(MultiviewRun, AnyNumberOfRanksGivesTheSameBytes)
{
  if (std::string(PCL_KSS_ICP_MPIRUN).empty())
    GTEST_SKIP() << "Built without MPI";
  const std::string alone = expected();
  for (const int number : {1, 2, 3}) {
    const std::string folder = "out" + std::to_string(number);
    const Outcome outcome =
        run(asRanks(number, multiview(some_, folder, {"--threads", "1", "--quiet"})));
    EXPECT_EQ(1, outcome.status) << outcome.errors;
    EXPECT_EQ(alone, results(folder)) << number;
  }
  const Outcome wrong = run(asRanks(2, multiview({"one"}, "out")));
  EXPECT_EQ(2, wrong.status);
  const std::string message = "needs two SCANS or more";
  EXPECT_TRUE(has(wrong.errors, message)) << wrong.errors;
  EXPECT_EQ(wrong.errors.find(message), wrong.errors.rfind(message)) << wrong.errors;
}

TEST_F(MultiviewRun, KilledRunsGoOn)
{
  const std::string whole = expected();
  std::size_t before = 0;
  for (const std::size_t answers : {2, 5}) {
    killWhenThereAre(answers, multiview(some_, "out", {"--threads", "2"}));
    EXPECT_FALSE(std::filesystem::exists(path("out/poses.json")));
    EXPECT_EQ(before > 0,
              has(content("errors"),
                  std::to_string(before) + " pieces of work are done already"))
        << content("errors");
    before = answersIn("out");
  }
  // what was being written
  write("out/journal.txt", content("out/journal.txt") + "{\"kind\":1,\"sou");
  const Outcome outcome = run(multiview(some_, "out", {"--threads", "2"}));
  EXPECT_EQ(1, outcome.status) << outcome.errors;
  EXPECT_TRUE(
      has(outcome.errors, std::to_string(before) + " pieces of work are done already"))
      << outcome.errors;
  EXPECT_EQ(whole, results("out"));
}

TEST_F(MultiviewRun, AnswersOfBeforeAreUsed)
{
  killWhenThereAre(5, multiview(some_, "out", {"--threads", "1"}));
  // an answer that is not what the scans would give: nobody looks at them again
  std::string journal = content("out/journal.txt");
  const std::string job = "{\"kind\":0,\"source\":3,\"target\":0}\t";
  const std::size_t answer = journal.find(job) + job.size();
  ASSERT_LE(job.size(), answer);
  const std::string reason = "[1,\"from the journal\"]";
  const std::size_t at = journal.find("\"failure\":[", answer) + 10;
  journal.replace(at, journal.find(']', at) + 1 - at, reason);
  write("out/journal.txt", journal);
  EXPECT_EQ(1, run(multiview(some_, "out")).status);
  EXPECT_EQ("from the journal", poses("out")["scans"][3]["reason"]);
}

TEST_F(MultiviewRun, ScansThatCouldNotBeUsedAreTriedAgain)
{
  // for a reason that its size and time do not tell of, as a disk that comes back
  const std::string good = content(scans_[1]);
  write(scans_[1], 'x' + good.substr(1));
  const auto time = std::filesystem::last_write_time(path(scans_[1]));
  const std::vector<std::string> words =
      multiview({scans_[1], scans_[0], scans_[2]}, "out", {"--threads", "1"});
  killWhenThereAre(2, words);
  write(scans_[1], good);
  std::filesystem::last_write_time(path(scans_[1]), time);
  const Outcome outcome = run(words);
  EXPECT_EQ(0, outcome.status) << outcome.errors << outcome.output;
  EXPECT_TRUE(has(outcome.errors, "done already")) << outcome.errors;
}

TEST_F(MultiviewRun, DamagedLinesOfTheJournalAreDoneAgain)
{
  const std::string whole = expected();
  killWhenThereAre(5, multiview(some_, "out", {"--threads", "1"}));
  std::string journal = content("out/journal.txt");
  // of one the middle, of another one even its end: it becomes one with the next
  std::size_t line = journal.find('\n') + 1;
  journal.replace(line + 100, 50, std::string(50, '\0'));
  line = journal.find('\n', line) + 1;
  journal[journal.find('\n', line)] = '?';
  write("out/journal.txt", journal);
  const Outcome outcome = run(multiview(some_, "out"));
  EXPECT_EQ(1, outcome.status) << outcome.errors;
  EXPECT_TRUE(has(outcome.errors, "warning: 2 lines of the journal cannot be read"))
      << outcome.errors;
  EXPECT_EQ(whole, results("out"));
}

TEST_F(MultiviewRun, WorkOfOtherScansOrSettingsIsNeitherUsedNorLost)
{
  const std::vector<std::string> two = {scans_[3], scans_[4]};
  killWhenThereAre(1, multiview(two, "out", {"--threads", "1"}));
  const std::string journal = content("out/journal.txt");
  const std::string anew = "; --restart begins anew, and another folder for --out";
  expectError(run(multiview(two, "out", {"--points", "300"})),
              "is of a run with other settings" + anew);
  const std::string other = "is of a run with other scans, or scans that have changed";
  expectError(run(multiview({scans_[4], scans_[3]}, "out")), other);
  const auto time = std::filesystem::last_write_time(path(scans_[4]));
  std::filesystem::last_write_time(path(scans_[4]), time + std::chrono::seconds(1));
  expectError(run(multiview(two, "out")), other);
  std::filesystem::last_write_time(path(scans_[4]), time);
  EXPECT_EQ(0u, content("out/journal.txt").find(journal));

  Outcome outcome = run(multiview(two, "out"));
  EXPECT_EQ(0, outcome.status) << outcome.errors;
  EXPECT_TRUE(has(outcome.errors, "done already")) << outcome.errors;
  write("out/journal.txt", journal);
  outcome = run(multiview(two, "out", {"--restart"}));
  EXPECT_EQ(0, outcome.status) << outcome.errors;
  EXPECT_FALSE(has(outcome.errors, "done already")) << outcome.errors;
}

TEST_F(MultiviewRun, TwoRunsInOneFolderAreOneTooMany)
{
  const pid_t child = start(multiview(some_, "out", {"--threads", "1"}));
  EXPECT_TRUE(waitFor([&] { return answersIn("out") >= 1; }));
  kill(child, SIGSTOP);
  expectError(run(multiview(some_, "out")),
              "out/journal.txt: is in use by another run");
  kill(child, SIGCONT);
  EXPECT_EQ(1, finish(child).status);
}

TEST_F(MultiviewRun, SignalsSayThatItGoesOn)
{
  const pid_t child = start(multiview(some_, "out", {"--threads", "1"}));
  EXPECT_TRUE(waitFor([&] { return answersIn("out") >= 1; }));
  kill(child, SIGTERM);
  const Outcome outcome = finish(child);
  EXPECT_EQ(143, outcome.status);
  EXPECT_TRUE(has(outcome.errors, "ended by SIGTERM\nwhat is done is kept; the same "
                                  "command goes on"))
      << outcome.errors;
}

TEST_F(MultiviewRun, FarAwayScansAreNotLessPrecise)
{
  // as maps have it, and each file by itself
  const Eigen::Vector3d offsets[] = {{523000.25, 5411000.5, 300.125},
                                     {523100.75, 5411200.25, 310.5}};
  for (int i = 0; i < 2; ++i) {
    Eigen::Matrix4d move = Eigen::Matrix4d::Identity();
    move.topRightCorner<3, 1>() = offsets[i];
    points_[3 + i].colwise() += offsets[i];
    T_scan_body_[3 + i] = move * T_scan_body_[3 + i];
    write(scans_[3 + i], asPLY(points_[3 + i]));
  }
  const Outcome outcome = run(multiview({scans_[3], scans_[4]}, "out"));
  EXPECT_EQ(0, outcome.status) << outcome.errors;
  EXPECT_LT(errorOf(poses("out"), 4, 1, 3, 0), 0.05);
  EXPECT_TRUE(has(content("out/merged_1.ply"), "property double x"));
}

TEST_F(MultiviewRun, NamesMayBeAnyBytes)
{
  const std::string name = "sc\xe4n \"1\"\n.ply";
  write(name, asPLY(points_[3]));
  const Outcome outcome = run(multiview({name, scans_[4]}, "out"));
  EXPECT_EQ(0, outcome.status) << outcome.errors;
  EXPECT_LT(errorOf(poses("out"), 4, 1, 3, 0), 0.05);
}

TEST_F(MultiviewRun, WrongCommandLines)
{
  expectError(run(multiview({scans_[0]}, "out")), "needs two SCANS or more, but got 1");
  expectError(run({PCL_KSS_ICP_MULTIVIEW, scans_[0], scans_[1]}), "needs --out DIR");
  expectError(run(multiview({scans_[0], scans_[1], "./" + scans_[0]}, "out")),
              "./scan_1.ply: is there twice");
  expectError(run(multiview(scans_, "out", {"--what"})), "--what");
  expectError(run(multiview(scans_, "out", {"--scale-range", "2"})), "--scale-range");
  expectError(run(multiview(scans_, "out", {"--memory", "0"})), "--memory");
  expectError(run(multiview(scans_, "scan_1.ply")), "scan_1.ply");
  EXPECT_FALSE(std::filesystem::exists(path("out")));
}

TEST_F(MultiviewRun, TellsWhatItCanDo)
{
  const Outcome help = run({PCL_KSS_ICP_MULTIVIEW, "--help"});
  EXPECT_EQ(0, help.status);
  for (const char* part : {"Usage: pcl_kss_icp_multiview", "--out DIR", "--restart",
                           "--free-scale", "Exit status:"})
    EXPECT_TRUE(has(help.output, part)) << part;
  std::istringstream rows(help.output);
  for (std::string row; std::getline(rows, row);)
    EXPECT_LE(row.size(), 79u) << row;
  const Outcome version = run({PCL_KSS_ICP_MULTIVIEW, "--version"});
  EXPECT_EQ(0, version.status);
  EXPECT_EQ(0u, version.output.find("pcl_kss_icp_multiview ")) << version.output;
}

} // namespace
