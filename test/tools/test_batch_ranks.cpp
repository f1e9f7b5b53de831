/*
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * The program for many pairs as the ranks of mpirun.
 */

#include "batch_run.h"

#include <cstdlib>

namespace {

using namespace kss_test;

/** Under mpirun, where there is one. */
class BatchRanks : public BatchRun {
protected:
  void
  SetUp() override
  {
    if (std::string(PCL_KSS_ICP_MPIRUN).empty())
      GTEST_SKIP() << "Built without MPI";
    BatchRun::SetUp();
    setenv("PCL_KSS_ICP_RANK_PATIENCE", "2", 1);
  }

  static std::vector<std::string>
  ranks(int number, std::vector<std::string> more)
  {
    for (const auto& word : {"--threads", "1", "--quiet"})
      more.push_back(word);
    return asRanks(number, batch(more));
  }

  /** Kill a rank that a process has started. */
  static void
  killRank(int rank, pid_t parent)
  {
    std::ifstream children("/proc/" + std::to_string(parent) + "/task/" +
                           std::to_string(parent) + "/children");
    for (pid_t child; children >> child;) {
      std::ostringstream variables;
      variables << std::ifstream("/proc/" + std::to_string(child) + "/environ").rdbuf();
      if (variables.str().find("OMPI_COMM_WORLD_RANK=" + std::to_string(rank) + '\0') !=
          std::string::npos) {
        kill(child, SIGKILL);
        return;
      }
    }
    ADD_FAILURE() << "there is no rank " << rank;
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
  killRank(1, child);
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
  killRank(1, child);
  const Outcome outcome = finish(child);
  EXPECT_NE(std::string::npos, outcome.errors.find("rank 1 is not heard of any more"))
      << outcome.errors;
  EXPECT_EQ(alone, results("out"));
  EXPECT_EQ(std::vector<int>(PAIRS, 1), timesDone("out"));
}

} // namespace
