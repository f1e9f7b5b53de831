/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "poses.h"

#include <pcl/registration/kss/devices.h>

#include "evaluators/evaluator_choice.h"
#include "evaluators/look_up_clouds.h"
#include "evaluators/look_ups.h"
#include "evaluators/pair_distances.h"
#include "geometry/distance_field.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>

#include <unistd.h>

namespace {

using namespace kss_test;
using namespace pcl::kss;

struct Distances {
  double farthest = 0.0, mean = 0.0;
};

constexpr float no_limit = std::numeric_limits<float>::max();

/** From every point of one cloud to the other, by the definition. */
Distances
directed(const Eigen::Matrix3Xd& from, const Eigen::Matrix3Xd& to, double limit)
{
  Distances distances;
  for (Eigen::Index i = 0; i < from.cols(); ++i) {
    double nearest = std::numeric_limits<double>::max();
    for (Eigen::Index j = 0; j < to.cols(); ++j)
      nearest = std::min(nearest, (from.col(i) - to.col(j)).norm());
    distances.farthest = std::max(distances.farthest, nearest);
    distances.mean += std::min(nearest, limit) / from.cols();
  }
  return distances;
}

/** Whether the evaluator's distances are those of the definition. */
void
expectRight(const DirectedDistances& found,
            const Points& source,
            const Points& target,
            const Placement& placement,
            float limit = no_limit)
{
  const Eigen::Matrix3Xd placed =
      placement.cast<double>() * source.cast<double>().colwise().homogeneous();
  const Eigen::Matrix3Xd fixed = target.cast<double>();
  const Distances there = directed(placed, fixed, limit);
  const Distances back = directed(fixed, placed, limit);
  // A placed coordinate is the sum of four float products, each rounded to 6e-8 of the
  // largest coordinate; a mean of up to 2000 lengths adds up to 1e-5 of itself.
  const double largest =
      std::max(placed.cwiseAbs().maxCoeff(), fixed.cwiseAbs().maxCoeff());
  const double rounding = 1e-6 * largest;
  EXPECT_NEAR(there.farthest, found.source_to_target, rounding);
  EXPECT_NEAR(back.farthest, found.target_to_source, rounding);
  EXPECT_NEAR(there.mean, found.mean_source_to_target, rounding + 1e-5 * there.mean);
  EXPECT_NEAR(back.mean, found.mean_target_to_source, rounding + 1e-5 * back.mean);
}

std::vector<Placement>
randomPlacements(std::size_t number, unsigned int seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> scale(0.5, 2.0);
  std::vector<Placement> placements;
  for (std::size_t i = 0; i < number; ++i) {
    // one after the other: a compiler evaluates arguments in any order
    const auto shift = randomVector(random, 0.3);
    const double factor = scale(random);
    const auto rotation = randomRotation(random);
    placements.push_back(
        similarity(rotation, factor, shift).topRows<3>().cast<float>());
  }
  return placements;
}

bool
sameBits(const std::vector<DirectedDistances>& a,
         const std::vector<DirectedDistances>& b)
{
  if (a.size() != b.size())
    return false;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (a[i].source_to_target != b[i].source_to_target ||
        a[i].target_to_source != b[i].target_to_source ||
        a[i].mean_source_to_target != b[i].mean_source_to_target ||
        a[i].mean_target_to_source != b[i].mean_target_to_source)
      return false;
  return true;
}

using MakeEvaluator = std::unique_ptr<DistanceEvaluator> (*)(unsigned int threads);

std::unique_ptr<DistanceEvaluator>
onOpenCL(unsigned int threads)
{
  return makeOpenCLPairDistances("auto", threads);
}

class Evaluator : public ::testing::TestWithParam<MakeEvaluator> {
protected:
  void
  SetUp() override
  {
    if (GetParam() == onOpenCL && openCLDeviceNames().empty())
      GTEST_SKIP() << "There is no OpenCL device on this machine.";
  }

  std::unique_ptr<DistanceEvaluator>
  make(unsigned int threads = 0) const
  {
    return GetParam()(threads);
  }
};

TEST_P(Evaluator, IsRightForAllSizes)
{
  // both clouds around the widths of vectors, tiles and groups
  const auto evaluator = make();
  const auto placements = randomPlacements(3, 1);
  for (const Eigen::Index n : {1, 2, 3, 4, 5, 7, 8, 9, 15, 16, 17, 31, 33, 63, 65, 130})
    for (const Eigen::Index m : {1, 2, 3, 4, 5, 7, 8, 9, 15, 16, 17, 31, 33, 64, 129}) {
      const Points source = Points::Random(3, n), target = Points::Random(3, m);
      evaluator->setClouds(source, target);
      const auto found = evaluator->evaluate(placements);
      ASSERT_EQ(placements.size(), found.size());
      for (std::size_t i = 0; i < placements.size(); ++i) {
        SCOPED_TRACE(::testing::Message() << n << " on " << m << " points");
        expectRight(found[i], source, target, placements[i]);
      }
    }
}

TEST_P(Evaluator, IsRightForThousandsOfPoints)
{
  const auto evaluator = make();
  const auto placements = randomPlacements(2, 2);
  const std::pair<int, int> sizes[] = {
      {2000, 2000}, {1999, 1023}, {1, 2000}, {2000, 1}};
  for (const auto& size : sizes) {
    const Points source = sampled(creature(), size.first, 3);
    const Points target = sampled(cross(), size.second, 4);
    evaluator->setClouds(source, target);
    const auto found = evaluator->evaluate(placements);
    for (std::size_t i = 0; i < placements.size(); ++i)
      expectRight(found[i], source, target, placements[i]);
  }
}

TEST_P(Evaluator, IsRightForAllNumbersOfPlacements)
{
  const Points source = sampled(creature(), 37, 5), target = sampled(creature(), 41, 6);
  const auto evaluator = make();
  evaluator->setClouds(source, target);
  // 20000 take more than one dispatch
  for (const std::size_t number : {0u, 1u, 63u, 64u, 65u, 1728u, 20000u}) {
    const auto placements = randomPlacements(number, 7);
    const auto found = evaluator->evaluate(placements);
    ASSERT_EQ(number, found.size());
    for (std::size_t i = 0; i<number; i += number> 100 ? 97 : 1)
      expectRight(found[i], source, target, placements[i]);
    if (number > 0)
      expectRight(found.back(), source, target, placements.back());
  }
}

TEST_P(Evaluator, FindsNoDistanceBetweenACloudAndItself)
{
  const Points cloud = sampled(creature(), 1001, 8);
  const auto evaluator = make();
  evaluator->setClouds(cloud, cloud);
  const Placement identity = Eigen::Matrix4f::Identity().topRows<3>();
  const DirectedDistances found = evaluator->evaluate({identity}).front();
  EXPECT_EQ(0.0f, found.hausdorff());
  EXPECT_EQ(0.0f, found.mean_source_to_target);
  EXPECT_EQ(0.0f, found.mean_target_to_source);
}

TEST_P(Evaluator, TellsTheTwoDirectionsApart)
{
  // half of a cloud lies on the whole, the whole not on the half
  Points whole(3, 20);
  for (int i = 0; i < 20; ++i)
    whole.col(i) = Eigen::Vector3f(static_cast<float>(i), 0.0f, 0.0f);
  const auto evaluator = make();
  const Placement identity = Eigen::Matrix4f::Identity().topRows<3>();
  evaluator->setClouds(whole.leftCols(10), whole);
  DirectedDistances found = evaluator->evaluate({identity}).front();
  EXPECT_EQ(0.0f, found.source_to_target);
  EXPECT_EQ(10.0f, found.target_to_source);
  EXPECT_EQ(0.0f, found.mean_source_to_target);
  EXPECT_FLOAT_EQ(55.0f / 20.0f, found.mean_target_to_source);
  EXPECT_EQ(10.0f, found.hausdorff());
  // clouds can be replaced, by larger and smaller ones
  evaluator->setClouds(whole, whole.leftCols(10));
  found = evaluator->evaluate({identity}).front();
  EXPECT_EQ(10.0f, found.source_to_target);
  EXPECT_EQ(0.0f, found.target_to_source);
}

TEST_P(Evaluator, CountsNoDistanceBeyondTheLimit)
{
  const auto evaluator = make();
  const auto placements = randomPlacements(5, 12);
  const Points source = sampled(creature(), 301, 13);
  const Points target = sampled(cross(), 203, 14);
  for (const float limit : {0.01f, 0.1f, 0.3f, 5.0f}) {
    evaluator->setClouds(source, target, limit);
    const auto found = evaluator->evaluate(placements);
    for (std::size_t i = 0; i < placements.size(); ++i) {
      SCOPED_TRACE(::testing::Message() << "limit " << limit);
      expectRight(found[i], source, target, placements[i], limit);
      EXPECT_LE(found[i].mean_source_to_target, limit * 1.00001f);
      EXPECT_LE(found[i].mean_target_to_source, limit * 1.00001f);
      // the largest distance is not cut
      EXPECT_GT(found[i].hausdorff(), 0.3f);
    }
  }
  // and none is forgotten when there is no limit any more
  evaluator->setClouds(source, target);
  expectRight(evaluator->evaluate(placements).front(), source, target,
              placements.front());
}

TEST_P(Evaluator, GivesTheSameBitsWithAnyNumberOfThreads)
{
  const Points source = sampled(creature(), 333, 9), target = sampled(cross(), 222, 10);
  const auto placements = randomPlacements(200, 11);
  std::vector<DirectedDistances> first;
  for (const unsigned int threads : {1u, 1u, 2u, 0u}) {
    const auto evaluator = make(threads);
    evaluator->setClouds(source, target);
    const auto found = evaluator->evaluate(placements);
    if (first.empty())
      first = found;
    EXPECT_TRUE(sameBits(first, found)) << threads << " threads";
  }
}

INSTANTIATE_TEST_SUITE_P(Host, Evaluator, ::testing::Values(&makeHostPairDistances));
INSTANTIATE_TEST_SUITE_P(OpenCL, Evaluator, ::testing::Values(&onOpenCL));

using MakeLookUps = std::unique_ptr<DistanceEvaluator> (*)(unsigned int threads,
                                                           unsigned int probes);

std::unique_ptr<DistanceEvaluator>
lookUpsOnOpenCL(unsigned int threads, unsigned int probes)
{
  return makeOpenCLLookUps("auto", threads, probes);
}

class LookUps : public ::testing::TestWithParam<MakeLookUps> {
protected:
  void
  SetUp() override
  {
    if (GetParam() == lookUpsOnOpenCL && openCLDeviceNames().empty())
      GTEST_SKIP() << "There is no OpenCL device on this machine.";
  }

  std::unique_ptr<DistanceEvaluator>
  make(unsigned int probes, unsigned int threads = 0) const
  {
    return GetParam()(threads, probes);
  }

  /** How far a looked-up distance may be too short: half a diagonal of a cell, which is
   * 0.35 limits wide and no finer than a fiftieth of the cloud. */
  static double
  roughness(const Points& cloud, double limit)
  {
    const double extent =
        (cloud.rowwise().maxCoeff() - cloud.rowwise().minCoeff()).maxCoeff();
    return 0.5 * std::sqrt(3.0) *
           std::max(0.35 * std::min(limit, 0.25 * extent), 0.02 * extent);
  }
};

/** How much longer than sqrt(3) times the true one a looked-up distance may be, in half
 * diagonals: 1 + sqrt(3) at the centre of a cell, and as much more as lies between. */
const double longestBeyond = 1.0 + 2.0 * std::sqrt(3.0);

TEST_P(LookUps, AreAsRightAsACellIsSmall)
{
  // the probes are the first points; around the widths of vectors and groups
  const Points source = sampled(creature(), 700, 15);
  const Points target = sampled(cross(), 900, 16);
  const auto placements = randomPlacements(60, 17);
  for (const unsigned int probes : {1u, 7u, 8u, 9u, 96u, 2000u})
    for (const float limit : {0.05f, 0.35f}) {
      const auto evaluator = make(probes);
      evaluator->setClouds(source, target, limit);
      const auto found = evaluator->evaluate(placements);
      ASSERT_EQ(placements.size(), found.size());
      double bias = 0.0;
      const double rough = std::max(roughness(source, limit), roughness(target, limit));
      for (std::size_t i = 0; i < placements.size(); ++i) {
        SCOPED_TRACE(::testing::Message() << probes << " probes, limit " << limit);
        const auto probesOf = [&](const Points& cloud) -> Eigen::Matrix3Xd {
          return cloud.leftCols(std::min<Eigen::Index>(probes, cloud.cols()))
              .cast<double>();
        };
        const Eigen::Matrix3Xd placed = placements[i].cast<double>() *
                                        source.cast<double>().colwise().homogeneous();
        const Distances there = directed(placed.leftCols(probesOf(source).cols()),
                                         target.cast<double>(), limit);
        const Distances back = directed(probesOf(target), placed, limit);
        const double scale = placements[i].leftCols<1>().norm();
        const auto expectAbout = [&](double mean, double looked_up, double half) {
          EXPECT_GE(looked_up, mean - half - 1e-5);
          EXPECT_LE(looked_up, std::sqrt(3.0) * mean + longestBeyond * half + 1e-5);
          if (probes >= 96) { // of many, few are nearly that long
            EXPECT_LE(looked_up, mean + half + 1e-5);
          }
        };
        expectAbout(there.mean, found[i].mean_source_to_target,
                    roughness(target, limit));
        expectAbout(back.mean, found[i].mean_target_to_source,
                    scale * roughness(source, limit));
        bias += (found[i].mean_source_to_target - there.mean) / placements.size();
      }
      // Centres of cells lie as often too near as too far; hardly on a surface, though.
      EXPECT_LT(std::abs(bias), 0.5 * rough);
    }
}

TEST_P(LookUps, FindTheRightPlacement)
{
  // what they are for: to rank placements as all pairs of points would
  const Points cloud = sampled(creature(), 500, 18);
  auto placements = randomPlacements(300, 19);
  placements.push_back(Eigen::Matrix4f::Identity().topRows<3>());
  const auto evaluator = make(96);
  evaluator->setClouds(cloud, sampled(creature(), 500, 20), 0.35f);
  const auto found = evaluator->evaluate(placements);
  const auto energy = [](const DirectedDistances& d) {
    return d.mean_source_to_target + d.mean_target_to_source;
  };
  for (std::size_t i = 0; i + 1 < found.size(); ++i)
    EXPECT_LT(1.3f * energy(found.back()), energy(found[i])) << i;
}

TEST_P(LookUps, GiveTheSameBitsWithAnyNumberOfThreads)
{
  const Points source = sampled(creature(), 333, 21);
  const Points target = sampled(cross(), 222, 22);
  const auto placements = randomPlacements(500, 23);
  std::vector<DirectedDistances> first;
  for (const unsigned int threads : {1u, 1u, 2u, 0u}) {
    const auto evaluator = make(96, threads);
    evaluator->setClouds(source, target, 0.35f);
    const auto found = evaluator->evaluate(placements);
    if (first.empty())
      first = found;
    EXPECT_TRUE(sameBits(first, found)) << threads << " threads";
  }
  EXPECT_TRUE(make(96)->deviceName() != "");
}

TEST_P(LookUps, FollowOtherCloudsAndAnotherLimit)
{
  // what is made of a cloud is kept for as long as the cloud and the limit are the same
  const Points a = sampled(creature(), 300, 29), b = sampled(cross(), 300, 30);
  const Points c = sampled(pennant(), 200, 31);
  const auto placements = randomPlacements(50, 32);
  const auto evaluator = make(96);
  struct Step {
    const Points &source, &target;
    float limit;
  };
  for (const Step& step : {Step{a, b, 0.3f}, Step{a, b, 0.3f}, Step{a, c, 0.3f},
                           Step{b, c, 0.3f}, Step{b, c, 0.1f}, Step{c, b, 0.1f}}) {
    evaluator->setClouds(step.source, step.target, step.limit);
    const auto fresh = make(96);
    fresh->setClouds(step.source, step.target, step.limit);
    EXPECT_TRUE(sameBits(fresh->evaluate(placements), evaluator->evaluate(placements)));
  }
}

TEST(LookUpClouds, KeepWhatIsMadeOfACloudThatHasNotChanged)
{
  const Points a = sampled(creature(), 30, 33), b = sampled(cross(), 40, 34);
  LookUpClouds<Eigen::Index> clouds(35);
  int made = 0;
  const auto madeFor = [&](const Points& source, const Points& target, float limit) {
    made = 0;
    clouds.set(source, target, limit, [&](const Points& probes, const DistanceField&) {
      ++made;
      return probes.cols();
    });
    return made;
  };
  EXPECT_EQ(2, madeFor(a, b, 0.3f));
  EXPECT_EQ(30, clouds.source());
  EXPECT_EQ(35, clouds.target());
  EXPECT_EQ(0, madeFor(a, b, 0.3f));
  EXPECT_EQ(1, madeFor(a, a, 0.3f));
  EXPECT_EQ(30, clouds.target());
  EXPECT_EQ(1, madeFor(b, a, 0.3f));
  EXPECT_EQ(2, madeFor(b, a, 0.2f));
  EXPECT_EQ(0.2f, clouds.limit());
  // nothing is kept of what could not be made
  EXPECT_THROW(clouds.set(a, a, 0.1f,
                          [](const Points&, const DistanceField&) -> Eigen::Index {
                            throw DeviceError("It is lost.");
                          }),
               DeviceError);
  EXPECT_EQ(2, madeFor(a, a, 0.1f));
}

TEST_P(LookUps, AreTheSameOnAllDevices)
{
  const Points source = sampled(creature(), 400, 24);
  const Points target = sampled(cross(), 500, 25);
  const auto placements = randomPlacements(500, 26);
  const auto reference = makeHostLookUps(1, 100), other = make(100);
  reference->setClouds(source, target, 0.35f);
  other->setClouds(source, target, 0.35f);
  const auto expected = reference->evaluate(placements);
  const auto found = other->evaluate(placements);
  for (std::size_t i = 0; i < placements.size(); ++i) {
    // on the border of two cells rounding decides: one or two of the 100 points at most
    EXPECT_NEAR(expected[i].mean_source_to_target, found[i].mean_source_to_target,
                0.005f);
    EXPECT_NEAR(expected[i].mean_target_to_source, found[i].mean_target_to_source,
                0.005f);
  }
}

TEST_P(LookUps, WorkForFlatClouds)
{
  const Points source = sampled(pennant(), 300, 27);
  const Points target = sampled(pennant(), 300, 28);
  const auto evaluator = make(96);
  evaluator->setClouds(source, target, 0.2f);
  const Placement identity = Eigen::Matrix4f::Identity().topRows<3>();
  const DirectedDistances found = evaluator->evaluate({identity}).front();
  EXPECT_LT(found.mean_source_to_target, roughness(target, 0.2) + 0.05);
  EXPECT_LT(found.mean_target_to_source, roughness(source, 0.2) + 0.05);
}

TEST(LookUpsDeathTest, AreMadeOfASinglePointInNoTime)
{
  // a point is all that setClouds() asks for
  EXPECT_EXIT(
      {
        alarm(5);
        const Points one = Points::Constant(3, 1, 0.5f);
        const auto evaluator = makeHostLookUps(1, 96);
        evaluator->setClouds(one, one, 0.35f);
        const Placement identity = Eigen::Matrix4f::Identity().topRows<3>();
        const DirectedDistances found = evaluator->evaluate({identity}).front();
        std::exit(found.mean_source_to_target <= 0.35f ? 0 : 1);
      },
      ::testing::ExitedWithCode(0), "");
}

INSTANTIATE_TEST_SUITE_P(Host, LookUps, ::testing::Values(&makeHostLookUps));
INSTANTIATE_TEST_SUITE_P(OpenCL, LookUps, ::testing::Values(&lookUpsOnOpenCL));

/** Of how many half diagonals the distance of a cell is too long, at its centre. */
double
longestError(const Points& cloud, float cell, float margin)
{
  const DistanceField field(cloud, cell, margin);
  const double edge = 1.0 / field.inverseEdge(), half = 0.5 * std::sqrt(3.0) * edge;
  double longest = 0.0;
  for (std::size_t i = 0; i < field.distances().size(); ++i) {
    const Eigen::Vector3i at(i % field.size().x(),
                             i / field.size().x() % field.size().y(),
                             i / field.size().x() / field.size().y());
    const Eigen::Vector3f center =
        field.lower() +
        (edge * (at.cast<double>().array() + 0.5)).matrix().cast<float>();
    const auto distances = (cloud.colwise() - center).colwise().norm();
    const double nearest = distances.minCoeff(), found = field.distances()[i];
    const double rounding = 1e-5 * (1.0 + nearest);
    EXPECT_NEAR((cloud.col(field.nearest(i)) - center).norm(), found, rounding);
    EXPECT_GE(found, nearest - rounding);
    EXPECT_LE(found,
              std::sqrt(3.0) * nearest + (1.0 + std::sqrt(3.0)) * half + rounding);
    longest = std::max(longest, (found - nearest) / half);
  }
  return longest;
}

TEST(DistanceField, KnowsPointsThatAreAsNearAsItSays)
{
  double longest = 0.0;
  for (unsigned int seed = 0; seed < 60 && !::testing::Test::HasFailure(); ++seed) {
    // few points, in clusters or not: most of the cells are far from any
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> coordinate(0.0f, 1.0f);
    Points cloud(3, 1 + random() % 40);
    for (float& value : cloud.reshaped())
      value = coordinate(random);
    if (seed % 3 == 1)
      cloud.row(2) *= 0.01f;
    if (seed % 3 == 2)
      cloud = (3.0f * cloud).array().floor() / 3.0f + 0.08f * cloud.array();
    longest = std::max(longest, longestError(cloud, 0.03f + 0.1f * coordinate(random),
                                             seed % 2 ? 0.3f : 1.0f));
  }
  // not all of them are the nearest, nor within half a diagonal of it
  EXPECT_GT(longest, 1.0);
}

TEST(Device, IsTheOneAskedFor)
{
  Settings settings;
  settings.device = "host";
  EXPECT_EQ("host", makePairDistances(settings)->deviceName());
  EXPECT_EQ("host", makeLookUps(settings)->deviceName());
  const auto names = openCLDeviceNames();
  if (names.empty())
    GTEST_SKIP() << "There is no OpenCL device on this machine.";
  for (const std::string& name : names) {
    settings.device = name;
    EXPECT_EQ(name, makePairDistances(settings)->deviceName());
    EXPECT_EQ(name, makeLookUps(settings)->deviceName());
    // part of a name will do
    settings.device = name.substr(1, 5);
    EXPECT_NO_THROW(makePairDistances(settings));
  }
  settings.device = "auto";
  const std::string found = makePairDistances(settings)->deviceName();
  EXPECT_EQ(1, std::count(names.begin(), names.end(), found));
}

TEST(Device, ThatDoesNotExistIsAnErrorThatListsThoseThatDo)
{
  Settings settings;
  settings.device = "Difference Engine";
  try {
    makePairDistances(settings);
    FAIL() << "no error";
  }
  catch (const DeviceError& error) {
    const std::string text = error.what();
    EXPECT_NE(std::string::npos, text.find("Difference Engine")) << text;
    for (const std::string& name : openCLDeviceNames())
      EXPECT_NE(std::string::npos, text.find(name)) << text;
  }
}

/** Run once more by ctest where PoCL cannot keep the programs that it builds. */
TEST(NoKernelCache, IsToldAsWhatItIs)
{
  const char* folder = std::getenv("POCL_CACHE_DIR");
  if (!folder || std::ofstream(std::string(folder) + "/some_file"))
    GTEST_SKIP() << "POCL_CACHE_DIR can be written.";
  if (access("/etc/OpenCL/vendors/pocl.icd", R_OK) != 0)
    GTEST_SKIP() << "PoCL is not installed.";
  try {
    makeOpenCLPairDistances("auto", 0);
    GTEST_SKIP() << "The device needs no such folder.";
  }
  catch (const DeviceError& error) {
    const std::string text = error.what();
    for (const char* part : {folder, "cannot be written", "Set POCL_CACHE_DIR"})
      EXPECT_NE(std::string::npos, text.find(part)) << text;
  }
  EXPECT_EQ("host", makePairDistances(Settings())->deviceName());
}

/** Run once more by ctest where the OpenCL loader is shown no driver. */
TEST(NoDevice, LeavesTheWorkToTheHost)
{
  if (!openCLDeviceNames().empty())
    GTEST_SKIP() << "There is an OpenCL device on this machine.";
  Settings settings;
  EXPECT_EQ("host", makePairDistances(settings)->deviceName());
  settings.device = "pthread";
  EXPECT_THROW(makePairDistances(settings), DeviceError);
  settings.search = Search::EXACT;
  EXPECT_THROW(makePairDistances(settings), DeviceError);
  EXPECT_THROW(makeOpenCLPairDistances("auto", 0), DeviceError);
  EXPECT_THROW(makeOpenCLLookUps("auto", 0, 96), DeviceError);
}

} // namespace
