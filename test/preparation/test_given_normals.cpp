/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "clouds.h"
#include "oriented_shapes.h"
#include "poses.h"

#include <pcl/registration/kss/detail/cloud_conversion.h>

#include "preparation/given_normals.h"
#include "preparation/preparation.h"

#include <gtest/gtest.h>

namespace {

using namespace kss_test;
using namespace pcl::kss;

/** A cloud with normals, every third of its points as a surface, and the normals found
 * there: about right, of any sign. */
class GivenNormals : public ::testing::Test {
protected:
  GivenNormals()
  {
    const Oriented whole = orientedEllipsoid({1.0f, 0.7f, 0.5f}, 6000, 1);
    cloud_.points = whole.points;
    cloud_.normals = whole.normals;
    surface_.points.resize(3, 2000);
    outside_.resize(3, 2000);
    for (Eigen::Index i = 0; i < 2000; ++i) {
      surface_.points.col(i) = whole.points.col(3 * (1999 - i));
      outside_.col(i) = whole.normals.col(3 * (1999 - i));
    }
    surface_.neighbourhoods = neighbourhoodsOf(surface_.points, 12, 1);
    found_ = noisy(outside_, 0.1, 2);
    found_.colwise().normalize();
    for (Eigen::Index i = 0; i < 2000; i += 2)
      found_.col(i) *= -1.0f;
  }

  LocalCloud cloud_;
  Surface surface_;
  Points outside_, found_;
};

TEST_F(GivenNormals, TakeThePlaceOfThoseFound)
{
  EXPECT_TRUE(takeGivenNormals(cloud_, surface_, found_));
  EXPECT_EQ(outside_, found_);
}

TEST_F(GivenNormals, OfSomePointsTurnTheOthers)
{
  for (Eigen::Index i = 0; i < 6000; i += 4)
    cloud_.normals.col(i).setZero();
  EXPECT_TRUE(takeGivenNormals(cloud_, surface_, found_));
  EXPECT_GT((outside_.array() * found_.array()).colwise().sum().minCoeff(), 0.7f);
}

TEST_F(GivenNormals, WithoutSidesAreTakenAsNormals)
{
  for (Eigen::Index i = 0; i < 6000; ++i)
    if (cloud_.normals(0, i) < 0.0f)
      cloud_.normals.col(i) *= -1.0f;
  EXPECT_FALSE(takeGivenNormals(cloud_, surface_, found_));
  EXPECT_LT((outside_.cwiseAbs() - found_.cwiseAbs()).cwiseAbs().maxCoeff(), 1e-6f);
}

TEST_F(GivenNormals, OfSomethingElseAreNot)
{
  const Points before = found_;
  for (Points normals : {Points(), Points(Points::Zero(3, 6000)),
                         noisy(Points::Zero(3, 6000), 1.0, 3)}) {
    for (Eigen::Index i = 0; i < normals.cols(); ++i)
      normals.col(i).normalize();
    cloud_.normals = normals;
    EXPECT_FALSE(takeGivenNormals(cloud_, surface_, found_));
    EXPECT_EQ(before, found_);
  }
}

TEST_F(GivenNormals, ThatChangeAreSeen)
{
  Preparation preparation({});
  const auto prepared = [&] {
    return preparation.prepared(cloud_, cloud_, [](double) {}).target;
  };
  const auto first = prepared();
  EXPECT_EQ(first, prepared());
  cloud_.normals *= -1.0f;
  const auto second = prepared();
  ASSERT_NE(first, second);
  // and used
  EXPECT_TRUE(first->planes.has_sides && second->planes.has_sides);
  EXPECT_EQ(first->planes.normals, -second->planes.normals);
  EXPECT_GT((first->planes.normals.array() * first->dense.points.array())
                .colwise()
                .sum()
                .minCoeff(),
            0.3f);
}

TEST(LocalNormals, AreThoseOfThePoints)
{
  const Oriented ball = orientedEllipsoid({1.0f, 1.0f, 1.0f}, 100, 5);
  const auto localOf = [](const auto& cloud) {
    return toLocalCloud(cloud, usablePointsOf(cloud, allIndices(cloud)));
  };
  const auto cloud = cloudOf<pcl::PointNormal>(ball.points);
  EXPECT_EQ(0, localOf(*cloud).normals.cols()); // all of them are zero
  for (Eigen::Index i = 0; i < 100; ++i)
    (*cloud)[i].getNormalVector3fMap() = (1.0f + i) * ball.normals.col(i);
  makeNaN((*cloud)[3]);
  (*cloud)[5].normal_y = std::numeric_limits<float>::quiet_NaN();
  (*cloud)[6].normal_y = std::numeric_limits<float>::infinity();
  const LocalCloud local = localOf(*cloud);
  ASSERT_EQ(99, local.points.cols());
  ASSERT_EQ(99, local.normals.cols());
  for (Eigen::Index i = 0; i < 99; ++i) {
    const Eigen::Index of = i < 3 ? i : i + 1;
    if (of == 5 || of == 6)
      EXPECT_TRUE(local.normals.col(i).isZero());
    else
      EXPECT_TRUE(local.normals.col(i).isApprox(ball.normals.col(of), 1e-5f));
  }
  // most have none
  for (Eigen::Index i = 0; i < 60; ++i)
    (*cloud)[i].getNormalVector3fMap().setZero();
  EXPECT_EQ(0, localOf(*cloud).normals.cols());
  EXPECT_EQ(0, localOf(*cloudOf<pcl::PointXYZ>(ball.points)).normals.cols());
}

} // namespace
