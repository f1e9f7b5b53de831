/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "reference_distances.h"

#include <pcl/registration/kss/devices.h>

#include "evaluators/look_up_clouds.h"
#include "evaluators/look_ups.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <vector>

#include <unistd.h>

namespace {

using namespace kss_test;
using namespace pcl::kss;

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

} // namespace
