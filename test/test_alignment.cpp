/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "local_cloud.h"
#include "poses.h"
#include "quick.h"

#include <pcl/registration/kss/alignment.h>
#include <pcl/registration/kss/detail/similarity.h>
#include <pcl/registration/kss/devices.h>

#include <gtest/gtest.h>

#include <map>
#include <stdexcept>

namespace {

using namespace kss_test;
using namespace pcl::kss;

Settings
quick()
{
  return quickSettings(300);
}

template <typename AlignmentT>
Aligned
alignedBy(AlignmentT&& alignment,
          const Points& source,
          const Points& target,
          double known_scale = 1.0)
{
  Stages stages;
  return alignment.align(local(source), local(target), known_scale, stages);
}

Alternatives
aligned(const Settings& settings,
        const Points& source,
        const Points& target,
        double known_scale = 1.0)
{
  return alignedBy(Alignment(settings), source, target, known_scale).alternatives;
}

TEST(Alignment, FindsRandomSimilarities)
{
  Settings settings = quick();
  for (const RotationSet set : {RotationSet::EULER, RotationSet::EVEN}) {
    settings.rotation_set = set;
    for (unsigned int seed = 0; seed < 3; ++seed) {
      const Points target = sampled(creature(), 6000, 2 * seed);
      const Eigen::Matrix4d truth = randomSimilarity(seed);
      const Points source =
          transformed(sampled(creature(), 4000, 2 * seed + 1), truth.inverse());
      const auto found = aligned(settings, source, target);
      ASSERT_FALSE(found.empty());
      // 300 samples lie 5 % of the diagonal apart; ICP on the clouds does the rest
      EXPECT_LT(displacement(found.front().transformation, truth, source), 0.03);
      EXPECT_NEAR(1.0, scaleIn(found.front().transformation) / scaleIn(truth), 0.03);
    }
  }
}

TEST(Alignment, FindsThePoseInThePapersDensity)
{
  Settings settings = quick();
  settings.density = Density::PAPER;
  const Eigen::Matrix4d truth = randomSimilarity(20);
  const Points source = transformed(sampled(creature(), 5000, 21), truth.inverse());
  const auto found = aligned(settings, source, sampled(creature(), 5000, 22));
  EXPECT_LT(displacement(found.front().transformation, truth, source), 0.05);
}

TEST(Alignment, IsNotLedAstrayByUnevenDensity)
{
  // one half of the source holds nine times the points of the other
  const Points even = sampled(creature(), 20000, 23);
  Points uneven(3, 0);
  for (Eigen::Index i = 0; i < even.cols(); ++i)
    if (even(0, i) > 0.0f || i % 9 == 0) {
      uneven.conservativeResize(3, uneven.cols() + 1);
      uneven.rightCols<1>() = even.col(i);
    }
  const Eigen::Matrix4d truth = randomSimilarity(24);
  const Points source = transformed(uneven, truth.inverse());
  const auto found = aligned(quick(), source, sampled(creature(), 10000, 25));
  EXPECT_LT(displacement(found.front().transformation, truth, source), 0.03);
}

TEST(Alignment, KeepsAKnownScale)
{
  Settings settings = quick();
  settings.estimate_scale = false;
  const Points target = sampled(creature(), 5000, 26);
  for (const double scale : {0.5, 1.0, 3.0}) {
    Eigen::Matrix4d truth = randomRigid(27);
    truth.topLeftCorner<3, 3>() *= scale;
    const Points source = transformed(sampled(creature(), 5000, 28), truth.inverse());
    const auto found = aligned(settings, source, target, scale);
    EXPECT_LT(displacement(found.front().transformation, truth, source), 0.03);
    for (const Alternative& alternative : found)
      EXPECT_NEAR(scale, scaleOf(alternative.transformation), 1e-9 * scale);
  }
}

TEST(Alignment, KeepsTheScaleWithinItsBounds)
{
  Settings settings = quick();
  const Points target = sampled(creature(), 3000, 126);
  const Points source = sampled(creature(), 3000, 127) / 2.0f;
  settings.smallest_scale = 1.8;
  settings.largest_scale = 2.5;
  EXPECT_NEAR(2.0, scaleOf(aligned(settings, source, target).front().transformation),
              0.06);
  settings.smallest_scale = 2.2;
  for (const Alternative& alternative : aligned(settings, source, target)) {
    EXPECT_GE(scaleOf(alternative.transformation), 2.2 * (1.0 - 1e-6));
    EXPECT_LE(scaleOf(alternative.transformation), 2.5 * (1.0 + 1e-6));
  }
}

TEST(Alignment, FindsThePoseInEveryModeThatFits)
{
  const Points whole = sampled(lump(), 2000, 128), other = sampled(lump(), 2000, 129);
  const Points front = part(other, {1, 0, 0}, 0.6);
  const Points left = part(whole, {0.3f, 1, 0}, 0.7);
  struct Case {
    Mode mode;
    const Points &source, &target;
  };
  const Case cases[] = {
      {Mode::GLOBAL_GLOBAL, other, whole},  {Mode::PARTIAL_GLOBAL, front, whole},
      {Mode::PARTIAL_GLOBAL, whole, front}, {Mode::PARTIAL_PARTIAL, front, left},
      {Mode::AUTOMATIC, other, whole},      {Mode::AUTOMATIC, front, whole},
      {Mode::AUTOMATIC, whole, front},      {Mode::AUTOMATIC, front, left}};
  Settings settings = quick();
  settings.estimate_scale = false;
  unsigned int seed = 130;
  for (const Case& tried : cases) {
    settings.mode = tried.mode;
    const Eigen::Matrix4d truth = randomRigid(seed++);
    const Points source = transformed(tried.source, truth.inverse());
    const auto found = aligned(settings, source, tried.target);
    EXPECT_LT(displacement(found.front().transformation, truth, source), 0.02) << seed;
  }
}

TEST(Alignment, IsThatOfThePaperIfAskedFor)
{
  Settings settings = paperSettings(quick());
  settings.sample_points = 300;
  const Eigen::Matrix4d truth = randomSimilarity(140);
  const Points source = transformed(sampled(creature(), 3000, 141), truth.inverse());
  const auto found = aligned(settings, source, sampled(creature(), 3000, 142));
  EXPECT_LT(displacement(found.front().transformation, truth, source), 0.03);
}

TEST(Alignment, ListsDistinctPosesTheLikeliestFirst)
{
  const Points source = sampled(creature(), 3000, 29);
  const Points target = sampled(creature(), 3000, 30);
  const auto [found, scorer] = alignedBy(Alignment(quick()), source, target);
  ASSERT_GT(found.size(), 1u);
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_TRUE(isSimilarity(found[i].transformation));
    // the overlap is the one that the scorer gives
    const Alternative judged = scorer.scored(found[i].transformation);
    EXPECT_EQ(found[i].transformation, judged.transformation);
    EXPECT_NEAR(judged.overlap.score, found[i].overlap.score, 1e-3);
    EXPECT_NEAR(judged.overlap.source, found[i].overlap.source, 2e-3);
    EXPECT_NEAR(judged.overlap.target, found[i].overlap.target, 2e-3);
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_GE(logOddsOf(found[j]), logOddsOf(found[i]));
      EXPECT_FALSE(scorer.areSame(found[i].transformation, found[j].transformation));
    }
  }
}

TEST(Alignment, ShowsTheFlipOfAFlatCloud)
{
  const Points source = sampled(pennant(), 3000, 31);
  const Points target = sampled(pennant(), 3000, 32);
  const Eigen::Matrix4d flip = turn(180.0, {1.0, 0.0, 0.0});
  const auto found = aligned(quick(), source, target);
  const auto holds = [&](const Eigen::Matrix4d& pose) {
    return std::any_of(found.begin(), found.end(), [&](const Alternative& listed) {
      return displacement(listed.transformation, pose, source) < 0.05;
    });
  };
  EXPECT_TRUE(holds(Eigen::Matrix4d::Identity()));
  EXPECT_TRUE(holds(flip));
  // both fit equally well, better than the next (in a plane, the same triangle a little
  // off still covers most of itself)
  ASSERT_GE(found.size(), 2u);
  EXPECT_GT(found[1].overlap.score, 0.95 * found[0].overlap.score);
  if (found.size() > 2) {
    EXPECT_LT(found[2].overlap.score, 0.95 * found[1].overlap.score);
  }
}

TEST(Alignment, RefinesMoreThanTheFirstOnlyWhereItIsNotGoodEnough)
{
  Settings settings = quick();
  // a flat cloud fits on either side
  const Points source = sampled(pennant(), 3000, 33);
  const Points target = sampled(pennant(), 3000, 34);
  EXPECT_GT(aligned(settings, source, target).size(), 1u);
  settings.additional_process_threshold = 10.0; // nothing is that far apart
  EXPECT_EQ(1u, aligned(settings, source, target).size());
}

TEST(Alignment, HasAnOverlapThatTellsRightFromWrong)
{
  Alignment alignment(quick());
  const Eigen::Matrix4d identity = Eigen::Matrix4d::Identity();
  for (unsigned int seed = 40; seed < 44; ++seed) {
    const Points source = sampled(creature(), 5000, seed);
    const PoseScorer scorer =
        alignedBy(alignment, source, sampled(creature(), 5000, seed + 10)).scorer;
    // two samplings of one surface come to one and a half
    EXPECT_NEAR(1.5, scorer.scored(identity).overlap.score, 0.1);
    EXPECT_LT(scorer.scored(turn(60.0, {0.0, 1.0, 0.0})).overlap.score, 0.45);
    const PoseScorer same = alignedBy(alignment, source, source).scorer;
    // nearest points are missed rarely: by one or two of 5000
    EXPECT_NEAR(2.0, same.scored(identity).overlap.score, 1e-3);
  }
}

TEST(Alignment, DependsNeitherOnTheDeviceNorOnThreads)
{
  const Eigen::Matrix4d truth = randomSimilarity(50);
  const Points source = transformed(sampled(creature(), 4000, 51), truth.inverse());
  const Points target = sampled(creature(), 4000, 52);
  Settings settings = quick();
  settings.device = "host";
  settings.threads = 1;
  const auto on_host = aligned(settings, source, target);
  for (const unsigned int threads : {1u, 2u, 0u}) {
    settings.threads = threads;
    const auto again = aligned(settings, source, target);
    ASSERT_EQ(on_host.size(), again.size());
    for (std::size_t i = 0; i < again.size(); ++i) {
      EXPECT_EQ(on_host[i].transformation, again[i].transformation);
      EXPECT_EQ(on_host[i].overlap.score, again[i].overlap.score);
    }
  }
  if (openCLDeviceNames().empty())
    GTEST_SKIP() << "There is no OpenCL device on this machine.";
  settings.device = "auto";
  settings.threads = 1;
  const auto on_device = aligned(settings, source, target);
  // the kernel's sums may round otherwise, which the result hardly feels
  EXPECT_LT(displacement(on_device.front().transformation,
                         on_host.front().transformation, source),
            1e-4);
  EXPECT_NEAR(on_host.front().overlap.score, on_device.front().overlap.score, 1e-3);
}

TEST(Alignment, KeepsNothingThatShows)
{
  const Points a = sampled(creature(), 2000, 60), b = sampled(creature(), 2000, 61);
  const Points c = transformed(sampled(creature(), 2000, 62), randomRigid(63));
  Points d = c; // as many points, but one is elsewhere
  d.col(7) = 0.5f * (d.col(8) + d.col(9));
  Settings settings = quick();
  settings.estimate_scale = false;
  Alignment alignment(settings);
  const auto expectAsFresh = [&](const Points& source, const Points& target,
                                 double known_scale) {
    const auto found = alignedBy(alignment, source, target, known_scale).alternatives;
    const auto expected = aligned(settings, source, target, known_scale);
    ASSERT_EQ(expected.size(), found.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
      EXPECT_EQ(expected[i].transformation, found[i].transformation);
      EXPECT_EQ(expected[i].overlap.score, found[i].overlap.score);
    }
  };
  expectAsFresh(a, b, 1.0);
  expectAsFresh(a, b, 1.0);
  expectAsFresh(a, b, 1.1);
  expectAsFresh(c, b, 1.0);
  expectAsFresh(d, b, 1.0);
  expectAsFresh(b, d, 1.0);
  expectAsFresh(b, c, 1.0);
  // noise asks for other steps, and leaves no trace
  expectAsFresh(noisy(a, 0.15, 64), noisy(b, 0.15, 65), 1.0);
  expectAsFresh(noisy(a, 0.15, 64), b, 1.0);
  expectAsFresh(a, b, 1.0);
}

TEST(Alignment, SaysWhichCloudDeterminesNoPose)
{
  Points line(3, 100);
  for (Eigen::Index i = 0; i < 100; ++i)
    line.col(i) = Eigen::Vector3f(1.0f, 2.0f, 3.0f) * static_cast<float>(i);
  const Points good = sampled(creature(), 500, 53);
  const auto errorOf = [](const Points& source, const Points& target) -> std::string {
    try {
      aligned(quick(), source, target);
    }
    catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "none";
  };
  EXPECT_NE(std::string::npos, errorOf(line, good).find("source"));
  EXPECT_NE(std::string::npos, errorOf(line, good).find("line"));
  EXPECT_NE(std::string::npos, errorOf(good, line).find("target"));
  const Points equal = Points::Constant(3, 100, 1.0f);
  EXPECT_NE(std::string::npos, errorOf(equal, good).find("coincide"));
}

TEST(Alignment, ReportsProgressAndTime)
{
  std::map<std::string, double> done;
  std::vector<std::string> order;
  Settings settings = quick();
  settings.progress = [&](const std::string& stage, double share) {
    EXPECT_GE(share, 0.0);
    EXPECT_LE(share, 1.0);
    if (done.count(stage) == 0)
      order.push_back(stage);
    else
      EXPECT_GE(share, done[stage]) << stage;
    done[stage] = share;
  };
  Alignment alignment(settings);
  Stages stages;
  stages.restart(settings.progress);
  alignment.align(local(sampled(creature(), 2000, 54)),
                  local(sampled(creature(), 2000, 55)), 1.0, stages);
  const std::vector<std::string> expected{"preparation", "simplification", "search",
                                          "refinement"};
  EXPECT_EQ(expected, order);
  for (const auto& stage : done)
    EXPECT_EQ(1.0, stage.second) << stage.first;
  std::vector<std::string> timed;
  for (const StageSeconds& stage : stages.seconds()) {
    timed.push_back(stage.stage);
    EXPECT_GE(stage.seconds, 0.0);
  }
  EXPECT_EQ(expected, timed);
}

} // namespace
