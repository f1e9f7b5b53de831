/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "local_cloud.h"
#include "poses.h"

#include "geometry/pre_shape.h"

#include <pcl/registration/kss/detail/similarity.h>

#include <gtest/gtest.h>

#include <stdexcept>

namespace {

using namespace kss_test;
using namespace pcl::kss;

TEST(PreShape, IsCentredAndOfUnitSize)
{
  const Points points = transformed(sampled(creature(), 3000, 1), randomSimilarity(1));
  const PreShape shape = toPreShape(local(points));
  const Eigen::Matrix3Xd unit = shape.points.cast<double>();
  // a float coordinate near 1 is off by up to 6e-8
  EXPECT_LT(unit.rowwise().mean().norm(), 1e-6);
  EXPECT_NEAR(1.0, std::sqrt(unit.squaredNorm() / unit.cols()), 1e-6);
  const Eigen::Matrix3Xd back = (shape.size * unit).colwise() + shape.center;
  EXPECT_LT((back - points.cast<double>()).cwiseAbs().maxCoeff(), 2e-6 * shape.size);
}

TEST(PreShape, ForgetsPlaceAndScaleAndNothingElse)
{
  const Points points = sampled(creature(), 1000, 2);
  const PreShape shape = toPreShape(local(points));
  for (unsigned int seed = 0; seed < 10; ++seed) {
    const Eigen::Matrix4d matrix = randomSimilarity(seed);
    const PreShape other = toPreShape(local(transformed(points, matrix)));
    const Eigen::Matrix3d rotation = matrix.topLeftCorner<3, 3>() / scaleIn(matrix);
    const Points turned = rotation.cast<float>() * shape.points;
    // the coordinates of the moved cloud, up to 10 units large, round to 1e-6
    EXPECT_LT((turned - other.points).cwiseAbs().maxCoeff(), 1e-5f);
    EXPECT_NEAR(scaleIn(matrix), other.size / shape.size, 1e-5);
  }
}

TEST(PreShape, ForgetsTheNumberOfPoints)
{
  const PreShape few = toPreShape(local(sampled(creature(), 2000, 3)));
  const PreShape many = toPreShape(local(sampled(creature(), 20000, 4)));
  // the standard error of a mean of 2000 squares is about 2 %
  EXPECT_NEAR(few.size, many.size, 0.04 * many.size);
}

TEST(PreShape, KeepsItsDigitsFarFromTheOrigin)
{
  const Points points = sampled(creature(), 1000, 5);
  const Eigen::Vector3d far(4.5e5, -5.4e6, 300.0);
  const PreShape here = toPreShape(local(points));
  const PreShape there = toPreShape(local(points, far));
  EXPECT_EQ(here.points, there.points);
  EXPECT_EQ(here.size, there.size);
  EXPECT_LT((there.center - far - here.center).norm(), 1e-8);
}

TEST(PreShape, MapsPosesBothWays)
{
  const PreShape source = toPreShape(local(sampled(creature(), 500, 6), {1, 2, 3}));
  const PreShape target = toPreShape(
      local(transformed(sampled(creature(), 500, 7), randomSimilarity(7)), {9, 0, 0}));
  for (unsigned int seed = 0; seed < 10; ++seed) {
    const Eigen::Matrix4d pose = randomSimilarity(seed);
    const Eigen::Matrix4d clouds = (target.T_cloud_shape() * Similarity::of(pose) *
                                    source.T_cloud_shape().inverse())
                                       .matrix();
    EXPECT_TRUE((target.T_cloud_shape().inverse() * Similarity::of(clouds) *
                 source.T_cloud_shape())
                    .matrix()
                    .isApprox(pose, 1e-12));
    // the definition: a point placed among the clouds, then brought to pre-shape space,
    // is the point brought there and then placed
    const Eigen::Vector3d unit(0.3, -0.2, 0.7);
    const Eigen::Vector3d in_source = source.center + source.size * unit;
    const Eigen::Vector3d placed = Eigen::Affine3d(clouds) * in_source;
    EXPECT_TRUE(((placed - target.center) / target.size)
                    .isApprox(Eigen::Affine3d(pose) * unit, 1e-12));
  }
}

TEST(PreShape, IdentityPoseMatchesCentresAndSizes)
{
  const PreShape source = toPreShape(local(sampled(creature(), 500, 8)));
  const PreShape target =
      toPreShape(local(transformed(sampled(cross(), 500, 9), randomSimilarity(9))));
  const Eigen::Matrix4d pose =
      (target.T_cloud_shape() * source.T_cloud_shape().inverse()).matrix();
  EXPECT_NEAR(target.size / source.size, scaleOf(pose), 1e-12);
  EXPECT_TRUE((Eigen::Affine3d(pose) * source.center).isApprox(target.center, 1e-12));
}

TEST(PreShape, TakesAnotherSize)
{
  const PreShape shape = toPreShape(local(sampled(creature(), 500, 10), {5, 5, 5}));
  const PreShape twice = withSize(shape, 2.0 * shape.size);
  EXPECT_EQ(2.0 * shape.size, twice.size);
  EXPECT_EQ(shape.center, twice.center);
  // the same cloud: center + size * point is where it was
  EXPECT_TRUE((twice.points * 2.0f).isApprox(shape.points, 1e-6f));
}

TEST(PreShape, RefusesCloudsThatDetermineNoRotation)
{
  EXPECT_THROW(toPreShape(local(Points::Constant(3, 1, 1.0f))), std::invalid_argument);
  EXPECT_THROW(toPreShape(local(Points::Constant(3, 50, 7.0f))), std::invalid_argument);
  EXPECT_THROW(toPreShape(local(Points::Random(3, 2))), std::invalid_argument);
  Points line(3, 100);
  for (Eigen::Index i = 0; i < 100; ++i)
    line.col(i) = Eigen::Vector3f(0.3f, -1.7f, 0.9f) * (0.01f * i * i);
  for (const float unit : {1e-6f, 1.0f, 1e6f})
    EXPECT_THROW(toPreShape(local(line * unit)), std::invalid_argument) << unit;
}

TEST(PreShape, AcceptsPlanarClouds)
{
  for (const float unit : {1e-6f, 1.0f, 1e6f})
    EXPECT_NO_THROW(toPreShape(local(sampled(pennant(), 100, 11) * unit))) << unit;
  Points triangle(3, 3);
  triangle << 0, 1, 0, 0, 0, 1, 0, 0, 0;
  EXPECT_NO_THROW(toPreShape(local(triangle)));
}

} // namespace
