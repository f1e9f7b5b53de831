/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "poses.h"

#include "candidates/centers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace {

using namespace kss_test;
using namespace pcl::kss;

/** A cloud about its mean, of unit root mean square radius. */
Points
centred(const Points& points)
{
  const Points moved = points.colwise() - points.rowwise().mean().eval();
  return moved / std::sqrt(moved.squaredNorm() / moved.cols());
}

Points
joined(const Points& points, const Points& more)
{
  Points all(3, points.cols() + more.cols());
  all << points, more;
  return all;
}

/** A row of points. */
Points
row(const Eigen::Vector3f& step, int number)
{
  Points points(3, number);
  for (int i = 0; i < number; ++i)
    points.col(i) = static_cast<float>(i) * step;
  return points;
}

/** The steps between centres along the three axes of the grid, in columns. */
Eigen::Matrix3d
stepsOf(const CandidateCenters& found)
{
  const auto at = [&](int i, int j, int k) {
    return found.centers[(i * found.steps[1] + j) * found.steps[2] + k];
  };
  Eigen::Matrix3d steps = Eigen::Matrix3d::Zero();
  if (found.steps[0] > 1)
    steps.col(0) = at(1, 0, 0) - at(0, 0, 0);
  if (found.steps[1] > 1)
    steps.col(1) = at(0, 1, 0) - at(0, 0, 0);
  if (found.steps[2] > 1)
    steps.col(2) = at(0, 0, 1) - at(0, 0, 0);
  return steps;
}

/** Whether the centres are a grid of these steps whose middle is the origin. */
void
expectGrid(const CandidateCenters& found)
{
  const auto [nx, ny, nz] = found.steps;
  ASSERT_EQ(static_cast<std::size_t>(nx * ny * nz), found.centers.size());
  const Eigen::Matrix3d steps = stepsOf(found);
  std::size_t index = 0;
  for (int i = 0; i < nx; ++i)
    for (int j = 0; j < ny; ++j)
      for (int k = 0; k < nz; ++k, ++index) {
        const Eigen::Vector3d expected =
            steps *
            Eigen::Vector3d(i - (nx - 1) / 2.0, j - (ny - 1) / 2.0, k - (nz - 1) / 2.0);
        ASSERT_LT((found.centers[index] - expected).norm(), 1e-9);
      }
  EXPECT_TRUE((found.axes.transpose() * found.axes).isIdentity(1e-9));
  for (int axis = 0; axis < 3; ++axis)
    if (found.steps[axis] > 1) {
      const Eigen::Vector3d step = found.spacing[axis] * found.axes.col(axis);
      EXPECT_LT((steps.col(axis) - step).norm(), 1e-9) << axis;
    }
}

/** What (e123) says about the grid of any cloud. */
void
expectPapersGrid(const Points& cloud)
{
  const CandidateCenters found = paperCenters(cloud);
  EXPECT_EQ(125u, found.centers.size());
  EXPECT_EQ((std::array<int, 3>{5, 5, 5}), found.steps);
  expectGrid(found);
  Eigen::Index farthest;
  const double radius =
      std::sqrt(cloud.cast<double>().colwise().squaredNorm().maxCoeff(&farthest));
  // r_s / 2, r_s being a quarter of that
  const Eigen::Matrix3d axes = stepsOf(found) / (radius / 8.0);
  EXPECT_TRUE((axes.transpose() * axes).isIdentity(1e-9)) << axes;
  EXPECT_NEAR(1.0, axes.determinant(), 1e-9);
  EXPECT_NEAR(radius, axes.col(1).dot(cloud.col(farthest).cast<double>()),
              1e-6 * radius);
}

TEST(OwnCenter, IsTheOrigin)
{
  const CandidateCenters found = ownCenter();
  ASSERT_EQ(1u, found.centers.size());
  EXPECT_TRUE(found.centers.front().isZero(0.0));
  EXPECT_EQ((std::array<int, 3>{1, 1, 1}), found.steps);
}

TEST(PaperCenters, AreACubeInTheFrameOfTheCloud)
{
  for (unsigned int seed = 0; seed < 5; ++seed) {
    const Points cloud =
        transformed(centred(sampled(creature(), 500, seed)),
                    similarity(Eigen::Quaterniond(Eigen::AngleAxisd(
                                   1.1 * seed, Eigen::Vector3d(1, 2, 3).normalized())),
                               1.0 + seed, Eigen::Vector3d::Zero()));
    expectPapersGrid(cloud);
    // Z is normal to the nearest point, too
    Eigen::Index nearest;
    cloud.colwise().squaredNorm().minCoeff(&nearest);
    const Eigen::Vector3d z = stepsOf(paperCenters(cloud)).col(2).normalized();
    EXPECT_NEAR(0.0, z.dot(cloud.col(nearest).cast<double>().normalized()), 1e-5);
  }
}

TEST(PaperCenters, TurnWithTheCloud)
{
  const Points cloud = centred(sampled(creature(), 500, 6));
  const Eigen::Matrix4d rotation = turn(77.0, {1.0, -2.0, 0.5});
  const auto before = paperCenters(cloud).centers;
  const auto after = paperCenters(transformed(cloud, rotation)).centers;
  for (std::size_t i = 0; i < before.size(); ++i)
    EXPECT_LT((rotation.topLeftCorner<3, 3>() * before[i] - after[i]).norm(), 1e-5);
}

TEST(PaperCenters, ExistForCloudsThatLeaveTheFrameToChance)
{
  // flat ones: Z is their normal
  const Points flat = centred(sampled(pennant(), 300, 7));
  expectPapersGrid(flat);
  EXPECT_GT(std::abs(stepsOf(paperCenters(flat)).col(2).normalized().z()), 1.0 - 1e-6);
  // a nearest point that has no direction, or that of the farthest
  const Points cloud = centred(sampled(creature(), 300, 8));
  expectPapersGrid(joined(Points::Zero(3, 1), cloud));
  Eigen::Index farthest;
  cloud.colwise().squaredNorm().maxCoeff(&farthest);
  for (const float share : {0.01f, -0.01f, 1e-5f})
    expectPapersGrid(joined(share * cloud.col(farthest), cloud));
  // almost a line: one point off it
  expectPapersGrid(
      centred(joined(row({1.0f, 2.0f, 0.5f}, 50), Eigen::Vector3f(3.0f, 6.1f, 1.5f))));
  // a triangle
  expectPapersGrid(centred(sampled(pennant(), 3, 9)));
}

TEST(SpreadCenters, FillABoxAlongThePrincipalAxes)
{
  const Points cloud = centred(sampled(creature(), 2000, 10));
  const Eigen::Matrix3d scatter = (cloud * cloud.transpose()).cast<double>() / 2000.0;
  for (const double reach : {0.5, 1.1, 2.0})
    for (const double step : {0.2, 0.3, 0.5}) {
      const CandidateCenters found = spreadCenters(cloud, reach, step);
      expectGrid(found);
      const Eigen::Matrix3d steps = stepsOf(found);
      for (int axis = 0; axis < 3; ++axis) {
        // odd: the cloud's own centre is one of them
        EXPECT_EQ(1, found.steps[axis] % 2);
        const double width = steps.col(axis).norm();
        EXPECT_LE(width, 1.01 * step);
        ASSERT_GT(width, 0.0);
        // a principal axis, and as far as told
        const Eigen::Vector3d direction = steps.col(axis) / width;
        const double variance = direction.dot(scatter * direction);
        EXPECT_LT((scatter * direction - variance * direction).norm(), 1e-4);
        const double radius = reach * std::sqrt(variance);
        EXPECT_NEAR(radius, (found.steps[axis] - 1) / 2 * width, 1e-3 * radius);
        // with no more centres than needed
        EXPECT_LT((found.steps[axis] - 3) / 2 * step, radius);
      }
    }
}

TEST(SpreadCenters, LieInThePlaneOfAFlatCloud)
{
  const Eigen::Matrix4d rotation = turn(40.0, {1.0, 1.0, 0.0});
  const Points cloud = transformed(centred(sampled(pennant(), 1000, 11)), rotation);
  const CandidateCenters found = spreadCenters(cloud, 1.1, 0.36);
  expectGrid(found);
  EXPECT_EQ(1, std::count(found.steps.begin(), found.steps.end(), 1));
  const Eigen::Vector3d normal =
      rotation.topLeftCorner<3, 3>() * Eigen::Vector3d::UnitZ();
  for (const Eigen::Vector3d& center : found.centers)
    EXPECT_NEAR(0.0, normal.dot(center), 1e-3);
}

TEST(SpreadCenters, CoverTheCenterOfTheRestWhenHalfIsMissing)
{
  // within half a diagonal of a cell of the box there is a centre
  for (unsigned int seed = 0; seed < 8; ++seed) {
    std::mt19937 random(seed);
    const Points cloud = centred(sampled(lump(), 2000, seed));
    const Points half =
        part(cloud, randomVector(random, 1.0).normalized().cast<float>(), 0.5);
    const Eigen::Vector3d rest = half.rowwise().mean().cast<double>();
    double nearest = 10.0;
    for (const Eigen::Vector3d& center : spreadCenters(cloud, 1.1, 0.36).centers)
      nearest = std::min(nearest, (center - rest).norm());
    EXPECT_GT(rest.norm(), 0.3);
    EXPECT_LT(nearest, 0.5 * std::sqrt(3.0) * 0.36);
  }
}

} // namespace
