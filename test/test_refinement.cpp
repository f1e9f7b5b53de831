/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "poses.h"

#include <pcl/registration/kss/refinement.h>

#include <gtest/gtest.h>

#include <limits>

namespace {

using namespace kss_test;
using pcl::kss::Refinement;

/** The scale of ICP with a least-squares fit of scale to one-sided nearest neighbours,
 * started at the truth: what the refinement's is to be better than. */
double
oneSidedScale(const Points& source, const Points& target)
{
  double scale = 1.0;
  for (int iteration = 0; iteration < 30; ++iteration) {
    const Points placed = source * static_cast<float>(scale);
    Points matched(3, source.cols());
    for (Eigen::Index i = 0; i < source.cols(); ++i) {
      Eigen::Index nearest;
      (target.colwise() - placed.col(i)).colwise().squaredNorm().minCoeff(&nearest);
      matched.col(i) = target.col(nearest);
    }
    const Points from = source.colwise() - source.rowwise().mean();
    const Points to = matched.colwise() - matched.rowwise().mean();
    scale = from.cwiseProduct(to).sum() / from.squaredNorm();
  }
  return scale;
}

TEST(Refinement, UndoesAKnownTransformationExactly)
{
  // The same points on both sides: what is left is rounding.
  const Points target = sampled(creature(), 1000, 1);
  std::mt19937 random(2);
  for (int i = 0; i < 5; ++i) {
    const Eigen::Matrix4d truth = randomSimilarity(i);
    const Points source = transformed(target, truth.inverse());
    const Eigen::Matrix4d start = turn(10.0, randomVector(random, 1.0)) * truth;
    const Eigen::Matrix4d found =
        Refinement(source, target).refine(start, true, {0, 100, 1e-9});
    // floats of up to 10 units round to 1e-6; the diagonal is above 1
    EXPECT_LT(displacement(found, truth, source), 1e-5);
  }
}

TEST(Refinement, AlignsIndependentSamplings)
{
  const Points target = sampled(creature(), 2000, 3);
  std::mt19937 random(4);
  for (int i = 0; i < 5; ++i) {
    const Eigen::Matrix4d truth = randomSimilarity(10 + i);
    const Points source =
        transformed(sampled(creature(), 2000, 5 + i), truth.inverse());
    const Eigen::Matrix4d start = turn(10.0, randomVector(random, 1.0)) * truth;
    const Eigen::Matrix4d found = Refinement(source, target).refine(start, true, {});
    // The spacing is about 2 % of the diagonal; thousands of pairs average it out.
    EXPECT_LT(displacement(found, truth, source), 0.01);
    EXPECT_LT(rotationErrorDegrees(found, truth), 1.5);
    EXPECT_NEAR(1.0, scaleIn(found) / scaleIn(truth), 0.01);
  }
}

TEST(Refinement, KeepsTheScaleWhereItIsKnown)
{
  const Points target = sampled(creature(), 500, 11);
  const Points source = sampled(creature(), 500, 12);
  for (const double scale : {0.9, 1.0, 1.2}) {
    Eigen::Matrix4d start = turn(10.0, {1.0, 1.0, 0.0});
    start.topLeftCorner<3, 3>() *= scale;
    const Eigen::Matrix4d found = Refinement(source, target).refine(start, false, {});
    EXPECT_NEAR(scale, std::cbrt(found.topLeftCorner<3, 3>().determinant()), 1e-9);
    // a rotation, not a mirror's
    const Eigen::Matrix3d rotation = found.topLeftCorner<3, 3>() / scale;
    EXPECT_TRUE((rotation * rotation.transpose()).isIdentity(1e-9));
  }
}

TEST(Refinement, DoesNotShrinkUnderNoise)
{
  double bias = 0.0, one_sided_bias = 0.0;
  constexpr int rounds = 5;
  for (unsigned int i = 0; i < rounds; ++i) {
    const Points source = noisy(sampled(creature(), 1500, 20 + i), 0.08, 30 + i);
    const Points target = noisy(sampled(creature(), 1500, 40 + i), 0.08, 50 + i);
    const Eigen::Matrix4d found =
        Refinement(source, target).refine(Eigen::Matrix4d::Identity(), true, {});
    bias += (scaleIn(found) - 1.0) / rounds;
    one_sided_bias += (oneSidedScale(source, target) - 1.0) / rounds;
  }
  // nearest neighbours pull inwards; two directions pull against each other
  EXPECT_LT(one_sided_bias, -0.02);
  EXPECT_LT(std::abs(bias), 0.01);
}

TEST(Refinement, PrefersNeitherCloud)
{
  // Exchanging the clouds gives the inverse pose: no direction weighs more.
  const Points a = noisy(sampled(creature(), 1000, 60), 0.05, 61);
  const Points b = noisy(sampled(creature(), 1000, 62), 0.05, 63);
  const Eigen::Matrix4d start = turn(5.0, {0.0, 1.0, 1.0});
  const Eigen::Matrix4d there = Refinement(a, b).refine(start, true, {0, 60, 1e-9});
  const Eigen::Matrix4d back =
      Refinement(b, a).refine(start.inverse(), true, {0, 60, 1e-9});
  EXPECT_NEAR(1.0, scaleIn(there) * scaleIn(back), 1e-3);
  EXPECT_LT(displacement(back * there, Eigen::Matrix4d::Identity(), a), 2e-3);
}

TEST(Refinement, AlignsFlatClouds)
{
  // Nothing in a plane tells a rotation from a mirror's turn; whether one slips in
  // depends on how the planes lie, hence many of them.
  for (unsigned int seed = 0; seed < 20; ++seed) {
    const Eigen::Matrix4d truth = randomSimilarity(seed);
    const Eigen::Matrix4d placed = randomSimilarity(100 + seed);
    const Points source = transformed(sampled(pennant(), 400, 71), truth.inverse());
    const Points target = transformed(sampled(pennant(), 400, 70), placed);
    const Eigen::Matrix4d start = placed * turn(8.0, {0.3, 1.0, 0.5}) * truth;
    const Eigen::Matrix4d found = Refinement(source, target).refine(start, true, {});
    EXPECT_GT(found.determinant(), 0.0) << seed;
    EXPECT_LT(displacement(found, placed * truth, source), 0.02) << seed;
  }
}

TEST(Refinement, StopsWhenToldTo)
{
  const Points target = sampled(creature(), 500, 80);
  const Points source = sampled(creature(), 500, 81);
  const Refinement refinement(source, target);
  const Eigen::Matrix4d start = turn(20.0, {1.0, 0.0, 0.0});
  EXPECT_EQ(start, refinement.refine(start, true, {0, 0, 1e-5}));
  // one step at a time is the same as several at once
  Eigen::Matrix4d stepped = start;
  for (int i = 0; i < 5; ++i)
    stepped = refinement.refine(stepped, true, {0, 1, 0.0});
  EXPECT_TRUE(stepped.isApprox(refinement.refine(start, true, {0, 5, 0.0}), 1e-12));
  // a tolerance that everything meets ends it after the first step
  EXPECT_EQ(refinement.refine(start, true, {0, 1, 1e-5}),
            refinement.refine(start, true, {0, 50, 100.0}));
}

TEST(Refinement, MakesDoWithSomeOfThePoints)
{
  const Points target = sampled(creature(), 2000, 90);
  const Points source = sampled(creature(), 2000, 91);
  const Eigen::Matrix4d found =
      Refinement(source, target)
          .refine(turn(10.0, {0.0, 0.0, 1.0}), true, {400, 30, 1e-5});
  EXPECT_LT(displacement(found, Eigen::Matrix4d::Identity(), source), 0.02);
}

} // namespace
