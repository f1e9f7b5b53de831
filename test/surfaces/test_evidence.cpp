/*
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * What surfaces say of a pose.
 */

#include "poses.h"

#include "surfaces/evidence.h"
#include "surfaces/skins.h"

#include <gtest/gtest.h>

namespace {

using namespace kss_test;
using namespace pcl::kss;

OrientedPoints
surfaceOf(const Points& points)
{
  const Neighbourhoods neighbourhoods = neighbourhoodsOf(points, 12, 1);
  OrientedPoints oriented;
  oriented.points = std::make_shared<NearestPoints>(points, neighbourhoods);
  oriented.planes.normals = normalsOf(points, neighbourhoods, 1);
  measureTrust(points, neighbourhoods, 1, oriented.planes);
  return oriented;
}

Similarity
shifted(double x, double y, double z)
{
  Similarity shift;
  shift.translation = {x, y, z};
  return shift;
}

/** A road between a long wall and, one in twenty points, a kerb across it. */
Points
road(unsigned int seed)
{
  Points points = scattered(6000, seed);
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    Eigen::Vector3f point = points.col(i);
    point.x() *= 4.0f;
    if (i % 20 == 0)
      point = {1.0f, point.y(), 0.5f * point.z()};
    else if (i % 2 == 0)
      point.z() = 0.0f;
    else
      point.y() = 0.0f;
    points.col(i) = point;
  }
  return points;
}

/** Both skins of a bent wall, or the upper one alone. */
Points
wall(Eigen::Index number, float thickness, unsigned int seed, bool both)
{
  Points points = scattered(number, seed);
  for (Eigen::Index i = 0; i < number; ++i) {
    const float x = points(0, i), y = points(1, i);
    points(2, i) = 0.3f * std::sin(2.0f * x) * y * y + 0.2f * x;
    if (both && i % 2 == 0)
      points(2, i) -= thickness;
  }
  return points;
}

TEST(Normals, AreThoseOfASphere)
{
  const Points points = sampled(ellipsoid({0, 0, 0}, {1, 1, 1}), 4000, 1);
  const OrientedPoints sphere = surfaceOf(points);
  double worst = 1.0;
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    worst = std::min<double>(
        worst, std::abs(sphere.planes.normals.col(i).dot(points.col(i).normalized())));
  EXPECT_GT(worst, 0.95);
}

TEST(Noise, IsMeasured)
{
  const Points points = sampled(box({0, 0, 0}, {1, 0.8, 0.6}), 6000, 2);
  for (const double sigma : {0.005, 0.01})
    EXPECT_NEAR(sigma, surfaceOf(noisy(points, sigma, 3)).planes.noise, 0.3 * sigma);
  EXPECT_LT(surfaceOf(points).planes.noise, 0.001);
}

TEST(Noise, IsNotTheOtherSkinOfAWall)
{
  EXPECT_LT(surfaceOf(wall(6000, 0.05f, 4, true)).planes.noise, 0.01);
}

TEST(Evidence, OfTheRightPoseIsNearlyFull)
{
  const OrientedPoints a = surfaceOf(sampled(creature(), 6000, 5));
  const OrientedPoints b = surfaceOf(sampled(creature(), 6000, 6));
  for (const bool scale_is_free : {false, true}) {
    const Evidence evidence = evidenceAt(a, b, Similarity(), scale_is_free);
    EXPECT_GT(evidence.source.worst, 0.6);
    EXPECT_GT(evidence.target.worst, 0.6);
    EXPECT_GT(evidence.source.consistent, 0.6);
    EXPECT_LT(evidence.residual, 1.2);
  }
}

TEST(Evidence, OfAPoseThatIsOffIsLittle)
{
  const OrientedPoints a = surfaceOf(sampled(creature(), 6000, 5));
  const OrientedPoints b = surfaceOf(sampled(creature(), 6000, 6));
  Similarity scaled;
  scaled.scale = 1.07;
  EXPECT_LT(evidenceAt(a, b, scaled, true).source.worst, 0.2);
  EXPECT_LT(evidenceAt(a, b, shifted(0.1, 0.1, 0.0), true).source.worst, 0.2);
}

TEST(Evidence, OfARoadIsNoneAboutASlideAlongIt)
{
  // nearly all points lie on the other scan, but for those that tell where along it
  const OrientedPoints a = surfaceOf(road(7)), b = surfaceOf(road(8));
  const Evidence slid = evidenceAt(a, b, shifted(0.5, 0.0, 0.0), false);
  const Evidence right = evidenceAt(a, b, Similarity(), false);
  EXPECT_GT(slid.source.explained, 0.6);
  EXPECT_LT(slid.source.worst, 0.3 * right.source.worst);
  EXPECT_GT(right.source.worst, 0.3);
}

TEST(Evidence, OfPartsCountsWhatContradicts)
{
  const Points whole = sampled(creature(), 8000, 9);
  const OrientedPoints b = surfaceOf(sampled(creature(), 8000, 10));
  const Evidence evidence =
      evidenceAt(surfaceOf(part(whole, {1, 0, 0}, 0.5)), b, Similarity(), false);
  EXPECT_GT(evidence.source.worst, 0.6);
  EXPECT_LT(evidence.target.worst, 0.3); // half of it has no counterpart
  EXPECT_GT(evidence.target.consistent, 0.5);
}

TEST(Evidence, HeedsSides)
{
  OrientedPoints a = surfaceOf(sampled(creature(), 4000, 11)), b = a;
  a.planes.has_sides = b.planes.has_sides = true;
  EXPECT_GT(evidenceAt(a, b, Similarity(), false).source.explained, 0.99);
  b.planes.normals = -b.planes.normals;
  EXPECT_EQ(0.0, evidenceAt(a, b, Similarity(), false).source.explained);
}

TEST(Skin, IsFoundFromBetweenTwo)
{
  const OrientedPoints source = surfaceOf(wall(5000, 0.0f, 12, false));
  const OrientedPoints target = surfaceOf(wall(10000, 0.04f, 13, true));
  const auto found = skinBeside(source, target, shifted(0, 0, -0.02), {1.0, 1.0},
                                turnsOf(RotationAxis::ANY));
  ASSERT_TRUE(found);
  EXPECT_NEAR(0.02, std::abs(found->translation.z() + 0.02), 0.008);
}

TEST(Skin, IsNotSoughtWhereAllIsExplained)
{
  const OrientedPoints source = surfaceOf(sampled(creature(), 5000, 14));
  const OrientedPoints target = surfaceOf(sampled(creature(), 5000, 15));
  EXPECT_FALSE(
      skinBeside(source, target, Similarity(), {0.5, 2.0}, turnsOf(RotationAxis::ANY)));
}

} // namespace
