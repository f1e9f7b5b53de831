/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "poses.h"

#include <pcl/registration/kss/hausdorff.h>
#include <pcl/registration/kss/opencl_devices.h>

#include <gtest/gtest.h>

#include <limits>

namespace {

using namespace kss_test;
using namespace pcl::kss;

struct Distances {
  double farthest = 0.0, mean = 0.0;
};

/** From every point of one cloud to the other, by the definition. */
Distances
directed(const Eigen::Matrix3Xd& from, const Eigen::Matrix3Xd& to)
{
  Distances distances;
  for (Eigen::Index i = 0; i < from.cols(); ++i) {
    double nearest = std::numeric_limits<double>::max();
    for (Eigen::Index j = 0; j < to.cols(); ++j)
      nearest = std::min(nearest, (from.col(i) - to.col(j)).norm());
    distances.farthest = std::max(distances.farthest, nearest);
    distances.mean += nearest / from.cols();
  }
  return distances;
}

/** Whether the evaluator's distances are those of the definition. */
void
expectRight(const HausdorffDistances& found,
            const Points& source,
            const Points& target,
            const Placement& placement)
{
  const Eigen::Matrix3Xd placed =
      placement.cast<double>() * source.cast<double>().colwise().homogeneous();
  const Eigen::Matrix3Xd fixed = target.cast<double>();
  const Distances there = directed(placed, fixed), back = directed(fixed, placed);
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
  for (std::size_t i = 0; i < number; ++i)
    placements.push_back(
        similarity(randomRotation(random), scale(random), randomVector(random, 0.3))
            .topRows<3>()
            .cast<float>());
  return placements;
}

bool
sameBits(const std::vector<HausdorffDistances>& a,
         const std::vector<HausdorffDistances>& b)
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

using MakeEvaluator = std::unique_ptr<HausdorffEvaluator> (*)(unsigned int threads);

std::unique_ptr<HausdorffEvaluator>
onOpenCL(unsigned int threads)
{
  return makeOpenCLEvaluator("auto", threads);
}

class Evaluator : public ::testing::TestWithParam<MakeEvaluator> {
protected:
  void
  SetUp() override
  {
    if (GetParam() == onOpenCL && openCLDeviceNames().empty())
      GTEST_SKIP() << "There is no OpenCL device on this machine.";
  }

  std::unique_ptr<HausdorffEvaluator>
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
  const HausdorffDistances found = evaluator->evaluate({identity}).front();
  EXPECT_EQ(0.0f, found.hausdorff());
  EXPECT_EQ(0.0f, found.mean());
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
  HausdorffDistances found = evaluator->evaluate({identity}).front();
  EXPECT_EQ(0.0f, found.source_to_target);
  EXPECT_EQ(10.0f, found.target_to_source);
  EXPECT_EQ(0.0f, found.mean_source_to_target);
  EXPECT_FLOAT_EQ(55.0f / 20.0f, found.mean_target_to_source);
  EXPECT_EQ(10.0f, found.hausdorff());
  EXPECT_FLOAT_EQ(0.5f * 55.0f / 20.0f, found.mean());
  // clouds can be replaced, by larger and smaller ones
  evaluator->setClouds(whole, whole.leftCols(10));
  found = evaluator->evaluate({identity}).front();
  EXPECT_EQ(10.0f, found.source_to_target);
  EXPECT_EQ(0.0f, found.target_to_source);
}

TEST_P(Evaluator, GivesTheSameBitsWithAnyNumberOfThreads)
{
  const Points source = sampled(creature(), 333, 9), target = sampled(cross(), 222, 10);
  const auto placements = randomPlacements(200, 11);
  std::vector<HausdorffDistances> first;
  for (const unsigned int threads : {1u, 1u, 2u, 0u}) {
    const auto evaluator = make(threads);
    evaluator->setClouds(source, target);
    const auto found = evaluator->evaluate(placements);
    if (first.empty())
      first = found;
    EXPECT_TRUE(sameBits(first, found)) << threads << " threads";
  }
}

INSTANTIATE_TEST_SUITE_P(Host, Evaluator, ::testing::Values(&makeHostEvaluator));
INSTANTIATE_TEST_SUITE_P(OpenCL, Evaluator, ::testing::Values(&onOpenCL));

TEST(Device, IsTheOneAskedFor)
{
  Settings settings;
  settings.device = "host";
  EXPECT_EQ("host", makeEvaluator(settings)->deviceName());
  const auto names = openCLDeviceNames();
  if (names.empty())
    GTEST_SKIP() << "There is no OpenCL device on this machine.";
  for (const std::string& name : names) {
    settings.device = name;
    EXPECT_EQ(name, makeEvaluator(settings)->deviceName());
    // part of a name will do
    settings.device = name.substr(1, 5);
    EXPECT_NO_THROW(makeEvaluator(settings));
  }
  settings.device = "auto";
  const std::string found = makeEvaluator(settings)->deviceName();
  EXPECT_EQ(1, std::count(names.begin(), names.end(), found));
}

TEST(Device, ThatDoesNotExistIsAnErrorThatListsThoseThatDo)
{
  Settings settings;
  settings.device = "Difference Engine";
  try {
    makeEvaluator(settings);
    FAIL() << "no error";
  }
  catch (const DeviceError& error) {
    const std::string text = error.what();
    EXPECT_NE(std::string::npos, text.find("Difference Engine")) << text;
    for (const std::string& name : openCLDeviceNames())
      EXPECT_NE(std::string::npos, text.find(name)) << text;
  }
}

/** Run once more by ctest where the OpenCL loader is shown no driver. */
TEST(NoDevice, LeavesTheWorkToTheHost)
{
  if (!openCLDeviceNames().empty())
    GTEST_SKIP() << "There is an OpenCL device on this machine.";
  Settings settings;
  EXPECT_EQ("host", makeEvaluator(settings)->deviceName());
  settings.device = "pthread";
  EXPECT_THROW(makeEvaluator(settings), DeviceError);
  EXPECT_THROW(makeOpenCLEvaluator("auto", 0), DeviceError);
}

} // namespace
