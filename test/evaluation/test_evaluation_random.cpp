/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "evaluation_cases.h"

#include "random.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <array>
#include <cmath>

using namespace evaluation;
using kss_test::turnsAboutEachAxisBy;

namespace {

constexpr int draws = 20000;

void
expectRotation(const Eigen::Matrix3d& r)
{
  EXPECT_LT((r * r.transpose() - Eigen::Matrix3d::Identity()).norm(), 1e-12);
  EXPECT_NEAR(1.0, r.determinant(), 1e-12);
}

} // namespace

TEST(EvaluationRandom, HashesAsPublished)
{
  // the test vectors of FNV-1a
  EXPECT_EQ(0xcbf29ce484222325u, hashOf(""));
  EXPECT_EQ(0xaf63dc4c8601ec8cu, hashOf("a"));
  EXPECT_EQ(0x85944171f73967e8u, hashOf("foobar"));
}

TEST(EvaluationRandom, StaysTheSame)
{
  // What the evaluation draws, on every machine; other values mean other cases.
  EXPECT_EQ(15499719951595230177u, randomFor("0/bunny/similarity/0")());
  Random random = randomFor("bunny");
  EXPECT_NEAR(2.377638847294678, uniform(random, -3.0, 5.0), 1e-12);
  EXPECT_NEAR(-1.040474725158248, gaussian(random), 1e-12);
  EXPECT_LT(
      (Eigen::Vector3d(0.4002241536852134, -0.8763869485891289, -0.2678927829367376) -
       direction(random))
          .norm(),
      1e-12);
  EXPECT_LT(
      (Eigen::Vector3d(0.8967805204055026, 0.1951908838364163, -0.3970959796930644) -
       rotation(random).col(0))
          .norm(),
      1e-12);
  EXPECT_LT(
      (Eigen::Vector3d(-0.1342703921447654, 0.2470443619313741, -0.9596564724062518) -
       rotationAboutAxes(random, M_PI / 6.0).col(0))
          .norm(),
      1e-12);
}

TEST(EvaluationRandom, NamesTellGeneratorsApart)
{
  EXPECT_EQ(randomFor("a/1")(), randomFor("a/1")());
  EXPECT_NE(randomFor("a/1")(), randomFor("a/2")());
  EXPECT_NE(randomFor("a/1")(), randomFor("1/a")());
}

TEST(EvaluationRandom, UniformNumbersFillTheInterval)
{
  Random random = randomFor("uniform");
  double sum = 0.0, squares = 0.0, least = 1e9, most = -1e9;
  for (int i = 0; i < draws; ++i) {
    const double x = uniform(random, 2.0, 6.0);
    sum += x - 4.0;
    squares += std::pow(x - 4.0, 2);
    least = std::min(least, x);
    most = std::max(most, x);
  }
  EXPECT_NEAR(0.0, sum / draws, 0.04);
  EXPECT_NEAR(16.0 / 12.0, squares / draws, 0.04);
  EXPECT_GE(least, 2.0);
  EXPECT_LT(least, 2.01);
  EXPECT_LE(most, 6.0);
  EXPECT_GT(most, 5.99);
}

TEST(EvaluationRandom, GaussianNumbersHaveTheirMoments)
{
  Random random = randomFor("gaussian");
  std::array<double, 5> moments{};
  for (int i = 0; i < draws; ++i) {
    const double x = gaussian(random);
    for (int power = 1; power <= 4; ++power)
      moments[power] += std::pow(x, power) / draws;
  }
  // four standard errors
  EXPECT_NEAR(0.0, moments[1], 4.0 * std::sqrt(1.0 / draws));
  EXPECT_NEAR(1.0, moments[2], 4.0 * std::sqrt(2.0 / draws));
  EXPECT_NEAR(0.0, moments[3], 4.0 * std::sqrt(15.0 / draws));
  EXPECT_NEAR(3.0, moments[4], 4.0 * std::sqrt(96.0 / draws));
}

TEST(EvaluationRandom, DirectionsAreSpreadEvenly)
{
  Random random = randomFor("direction");
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  for (int i = 0; i < draws; ++i) {
    const Eigen::Vector3d d = direction(random);
    ASSERT_NEAR(1.0, d.norm(), 1e-12);
    sum += d / draws;
    squares += d * d.transpose() / draws;
  }
  EXPECT_LT(sum.norm(), 0.02);
  EXPECT_LT((squares - Eigen::Matrix3d::Identity() / 3.0).norm(), 0.02);
}

TEST(EvaluationRandom, RotationsAreSpreadEvenly)
{
  Random random = randomFor("rotation");
  double trace = 0.0, squared_trace = 0.0;
  int small = 0;
  for (int i = 0; i < draws; ++i) {
    const Eigen::Matrix3d r = rotation(random);
    if (i < 100)
      expectRotation(r);
    trace += r.trace() / draws;
    squared_trace += r.trace() * r.trace() / draws;
    small += !turnsAboutEachAxisBy(30.0, r);
  }
  // the moments of the trace under Haar's measure
  EXPECT_NEAR(0.0, trace, 0.03);
  EXPECT_NEAR(1.0, squared_trace, 0.05);
  EXPECT_GT(small, draws / 10);
}

TEST(EvaluationRandom, TurnsAboutEachAxisByMoreThanTheLeast)
{
  Random random = randomFor("axes");
  bool positive = false, negative = false;
  for (int i = 0; i < 2000; ++i) {
    const Eigen::Matrix3d r = rotationAboutAxes(random, M_PI / 6.0);
    expectRotation(r);
    ASSERT_TRUE(turnsAboutEachAxisBy(30.0, r)) << i;
    positive |= r(1, 0) > 0.9;
    negative |= r(1, 0) < -0.9;
  }
  EXPECT_TRUE(positive && negative);
}
