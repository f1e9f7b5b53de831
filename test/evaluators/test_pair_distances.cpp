/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "reference_distances.h"

#include <pcl/registration/kss/devices.h>

#include "evaluators/pair_distances.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

namespace {

using namespace kss_test;
using namespace pcl::kss;

constexpr float no_limit = std::numeric_limits<float>::max();

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

} // namespace
