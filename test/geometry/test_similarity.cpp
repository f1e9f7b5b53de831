/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "poses.h"

#include <pcl/registration/kss/detail/similarity.h>

#include "geometry/similarity.h"

#include <gtest/gtest.h>

#include <limits>

namespace {

using namespace kss_test;
using namespace pcl::kss;

TEST(Similarity, IsItsMatrix)
{
  for (unsigned int seed = 0; seed < 10; ++seed) {
    const Eigen::Matrix4d matrix = randomSimilarity(seed);
    const Similarity similarity = Similarity::of(matrix);
    EXPECT_NEAR(scaleIn(matrix), similarity.scale, 1e-12);
    EXPECT_TRUE(
        (similarity.rotation * similarity.rotation.transpose()).isIdentity(1e-12));
    EXPECT_TRUE(similarity.matrix().isApprox(matrix, 1e-14));
    EXPECT_EQ(similarity.matrix().topRows<3>().cast<float>(), similarity.placement());
    EXPECT_EQ(similarity.matrix().cast<float>(), similarity.affine().matrix());
  }
}

TEST(Similarity, IsInvertedAndMultipliedAsItsMatrixIs)
{
  for (unsigned int seed = 0; seed < 10; ++seed) {
    const Eigen::Matrix4d a = randomSimilarity(2 * seed);
    const Eigen::Matrix4d b = randomSimilarity(2 * seed + 1);
    const Similarity T_c_b = Similarity::of(a), T_b_a = Similarity::of(b);
    EXPECT_TRUE(T_c_b.inverse().matrix().isApprox(a.inverse(), 1e-12));
    EXPECT_TRUE((T_c_b * T_b_a).matrix().isApprox(a * b, 1e-12));
    EXPECT_TRUE((T_c_b * T_c_b.inverse()).matrix().isIdentity(1e-12));
  }
}

TEST(Similarity, IsUsableWhereItsNumbersAre)
{
  const Similarity good = Similarity::of(randomSimilarity(1));
  EXPECT_TRUE(good.isUsable());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double scale : {nan, 0.0, -1.0, 1e26, 1e-26}) {
    Similarity bad = good;
    bad.scale = scale;
    EXPECT_FALSE(bad.isUsable()) << scale;
  }
  for (const double coordinate : {nan, 1e31}) {
    Similarity bad = good;
    bad.translation[1] = coordinate;
    EXPECT_FALSE(bad.isUsable()) << coordinate;
    bad = good;
    bad.rotation(2, 0) = coordinate;
    EXPECT_FALSE(bad.isUsable()) << coordinate;
  }
}

TEST(Similarity, IsRecognised)
{
  for (unsigned int seed = 0; seed < 10; ++seed) {
    const Eigen::Matrix4d matrix = randomSimilarity(seed);
    EXPECT_TRUE(isSimilarity(matrix));
    EXPECT_NEAR(scaleIn(matrix), scaleOf(matrix), 1e-12);
    // as a float matrix would bring it
    EXPECT_TRUE(isSimilarity(matrix.cast<float>().cast<double>()));
  }
}

TEST(Similarity, IsToldFromEverythingElse)
{
  const Eigen::Matrix4d good = randomSimilarity(3);
  EXPECT_FALSE(isSimilarity(Eigen::Matrix4d::Zero()));
  Eigen::Matrix4d bad = good;
  bad.col(0) *= -1.0; // mirrored
  EXPECT_FALSE(isSimilarity(bad));
  bad = good;
  bad.topLeftCorner<3, 3>().col(1) *= 1.1; // sheared or stretched
  EXPECT_FALSE(isSimilarity(bad));
  bad = good;
  bad(3, 0) = 0.1; // projective
  EXPECT_FALSE(isSimilarity(bad));
  for (const double value : {std::numeric_limits<double>::quiet_NaN(),
                             std::numeric_limits<double>::infinity()})
    for (Eigen::Index entry = 0; entry < good.size(); ++entry) {
      bad = good;
      bad.data()[entry] = value;
      EXPECT_FALSE(isSimilarity(bad)) << entry;
    }
}

} // namespace
