/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "oriented_shapes.h"

#include "geometry/sides.h"

#include <gtest/gtest.h>

namespace {

using namespace kss_test;
using namespace pcl::kss;

bool
areConsistent(const Oriented& cloud)
{
  return sidesAreConsistent(cloud.points, cloud.normals,
                            neighbourhoodsOf(cloud.points, 12, 1));
}

/** Turned as pcl::NormalEstimation turns them. */
Oriented
turnedTowards(const Eigen::Vector3f& viewpoint, Oriented cloud)
{
  for (Eigen::Index i = 0; i < cloud.points.cols(); ++i)
    if (cloud.normals.col(i).dot(viewpoint - cloud.points.col(i)) < 0.0f)
      cloud.normals.col(i) *= -1.0f;
  return cloud;
}

std::vector<Oriented>
wholeObjects(Eigen::Index number)
{
  return {orientedEllipsoid({1.0f, 1.0f, 1.0f}, number, 1),
          orientedEllipsoid({1.0f, 0.6f, 0.2f}, number, 2),
          orientedBox({1.0f, 1.0f, 1.0f}, number, 3),
          orientedBox({2.0f, 1.0f, 0.4f}, number, 4)};
}

TEST(Sides, AreConsistentWhereAllNormalsPointOutwardsOrInwards)
{
  for (const Eigen::Index number : {1000, 12000})
    for (Oriented& cloud : wholeObjects(number)) {
      EXPECT_TRUE(areConsistent(cloud));
      cloud.normals *= -1.0f;
      EXPECT_TRUE(areConsistent(cloud));
    }
}

TEST(Sides, AreContradictoryWhereAllNormalsFaceAViewpoint)
{
  for (const Eigen::Index number : {1000, 12000})
    for (const Oriented& cloud : wholeObjects(number))
      for (const Eigen::Vector3f& view :
           {Eigen::Vector3f(5.0f, 0.0f, 0.0f), Eigen::Vector3f(0.0f, 4.0f, 0.2f),
            Eigen::Vector3f(3.0f, 3.0f, 4.0f), Eigen::Vector3f(-1.0f, 2.0f, -9.0f)})
        EXPECT_FALSE(areConsistent(turnedTowards(view, cloud)))
            << number << ", " << view.transpose();
}

TEST(Sides, OfThinWallsAreNoContradiction)
{
  // the skins are closer than points of one skin
  for (const float thickness : {0.003f, 0.01f, 0.03f}) {
    const Oriented wall = orientedBox({1.0f, 1.0f, thickness / 2.0f}, 4000, 5);
    EXPECT_TRUE(areConsistent(wall)) << thickness;
  }
  // two sheets that both face upwards cannot be told from one that is noisy
  Oriented sheets{sampled(box({0.0, 0.0, 0.0}, {1.0, 1.0, 0.0}), 4000, 6),
                  Points::Zero(3, 4000)};
  sheets.normals.row(2).setOnes();
  EXPECT_TRUE(areConsistent(sheets));
  for (Eigen::Index i = 0; i < 4000; i += 2)
    sheets.points(2, i) = 0.015f;
  EXPECT_FALSE(areConsistent(sheets));
}

TEST(Sides, OfOneViewAreConsistent)
{
  const Oriented whole = orientedEllipsoid({1.0f, 0.8f, 0.6f}, 6000, 7);
  const Eigen::Vector3f viewpoint(0.0f, 0.0f, 9.0f);
  Oriented view{Points(3, 6000), Points(3, 6000)};
  Eigen::Index seen = 0;
  for (Eigen::Index i = 0; i < whole.points.cols(); ++i)
    if (whole.normals.col(i).dot(viewpoint - whole.points.col(i)) > 0.0f) {
      view.points.col(seen) = whole.points.col(i);
      view.normals.col(seen++) = whole.normals.col(i);
    }
  view.points.conservativeResize(3, seen);
  view.normals.conservativeResize(3, seen);
  EXPECT_TRUE(areConsistent(turnedTowards(viewpoint, view)));
}

TEST(Sides, AreUnknownWithoutNormalsOrOrder)
{
  Oriented cloud = orientedEllipsoid({1.0f, 0.8f, 0.6f}, 3000, 8);
  const Oriented whole = cloud;
  for (Eigen::Index i = 0; i < cloud.normals.cols(); i += 3)
    cloud.normals.col(i).setZero();
  EXPECT_TRUE(areConsistent(cloud)); // where they are known
  for (Eigen::Index i = 0; i < cloud.normals.cols(); i += 2)
    cloud.normals.col(i) *= -1.0f;
  EXPECT_FALSE(areConsistent(cloud));
  cloud.normals.setZero();
  EXPECT_FALSE(areConsistent(cloud));
  // a few mistakes are no other side
  cloud = whole;
  for (Eigen::Index i = 0; i < cloud.normals.cols(); i += 1000)
    cloud.normals.col(i) *= -1.0f;
  EXPECT_TRUE(areConsistent(cloud));
}

} // namespace
