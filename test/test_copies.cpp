/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "clouds.h"
#include "local_cloud.h"
#include "poses.h"

#include <pcl/registration/kss/detail/copies.h>
#include <pcl/registration/kss/detail/similarity.h>

#include <gtest/gtest.h>

#include <limits>

namespace {

using namespace kss_test;
using namespace pcl::kss;

/** Points where a pose has placed them, in another order. */
Points
copyOf(const Points& points, const Eigen::Matrix4d& pose)
{
  return transformed(points, pose).rowwise().reverse();
}

Alternatives
copies(const Points& source,
       const Points& target,
       const Settings& settings = {},
       const std::optional<StoredPose>& guess = {})
{
  return copiesOf(local(source), local(target), settings, guess);
}

TEST(Copies, OfFewPointsAreFoundWhereverTheyLie)
{
  for (const Eigen::Index number : {4, 5, 8, 20, 40})
    for (unsigned int seed = 1; seed < 20; ++seed) {
      const Points points = scattered(number, seed);
      const Eigen::Matrix4d pose = randomSimilarity(seed);
      const Alternatives found = copies(points, copyOf(points, pose));
      ASSERT_EQ(1u, found.size()) << number << " points, seed " << seed;
      EXPECT_LT((found.front().transformation - pose).cwiseAbs().maxCoeff(), 1e-5);
      EXPECT_GE(confidenceOf(found), 0.8);
    }
}

TEST(Copies, AreExactAndOfAsManyPoints)
{
  for (unsigned int seed = 1; seed < 50; ++seed) {
    const Points points = scattered(5, seed);
    Points other = points;
    other(0, 0) += 0.01f;
    EXPECT_TRUE(copies(points, other).empty());
    EXPECT_TRUE(copies(points, scattered(5, seed + 100)).empty());
    EXPECT_TRUE(copies(points, points.leftCols(4)).empty());
    // three fit by chance, and those on a line may turn
    EXPECT_TRUE(copies(points.leftCols(3), points.leftCols(3)).empty());
    Points line = points;
    line.bottomRows(2).setZero();
    EXPECT_TRUE(copies(line, line).empty());
    // a mirror image is none
    Points mirrored = points;
    mirrored.row(0) *= -1.0f;
    EXPECT_TRUE(copies(points, mirrored).empty());
  }
  EXPECT_TRUE(copies(Points::Zero(3, 5), Points::Zero(3, 5)).empty());
  const Points many = scattered(41, 1);
  EXPECT_TRUE(copies(many, many).empty());
}

TEST(Copies, KeepToTheScaleAndTheAxis)
{
  const Points points = scattered(6, 3);
  const Points larger = points * 2.0f;
  Settings settings;
  EXPECT_EQ(1u, copies(points, larger, settings).size());
  settings.largest_scale = 1.9;
  EXPECT_TRUE(copies(points, larger, settings).empty());
  settings.largest_scale = std::numeric_limits<double>::infinity();
  settings.estimate_scale = false;
  EXPECT_TRUE(copies(points, larger, settings).empty());
  const StoredPose guess = similarity(Eigen::Quaterniond::Identity(), 2.0, {0, 0, 0});
  EXPECT_EQ(1u, copies(points, larger, settings, guess).size());
  EXPECT_EQ(1u, copies(points, points, settings).size());
  // turned about x
  const Points turned = transformed(
      points,
      similarity(Eigen::Quaterniond(Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitX())),
                 1.0, {0, 0, 0}));
  settings.rotation_axis = RotationAxis::X;
  EXPECT_EQ(1u, copies(points, turned, settings).size());
  settings.rotation_axis = RotationAxis::Z;
  EXPECT_TRUE(copies(points, turned, settings).empty());
}

TEST(Copies, OfSymmetricPointsAreAmbiguous)
{
  Points square(3, 4);
  square << 1, -1, -1, 1, 1, 1, -1, -1, 0, 0, 0, 0;
  const Eigen::Quaterniond quarter(
      Eigen::AngleAxisd(0.5 * M_PI, Eigen::Vector3d::UnitZ()));
  const StoredPose guess = similarity(quarter, 1.0, {0, 0, 0});
  const Alternatives found = copies(square, square, {}, guess);
  EXPECT_EQ(8u, found.size());
  EXPECT_TRUE(isAmbiguous(found));
  // the one that is nearest to the guess first
  EXPECT_TRUE(found.front().transformation.isApprox(guess, 1e-6));
  EXPECT_TRUE(copies(square, square).front().transformation.isIdentity(1e-6));
}

} // namespace
