/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "poses.h"

#include "geometry/tangent_planes.h"
#include "refinement/plane_pulls.h"
#include "refinement/refinement.h"

#include <gtest/gtest.h>

#include <limits>

namespace {

using namespace kss_test;
using pcl::kss::NearestPoints;
using pcl::kss::Refinement;
using pcl::kss::RotationAxis;
using pcl::kss::ScaleRange;
using pcl::kss::Similarity;
using pcl::kss::SurfacePoints;

constexpr ScaleRange any_scale{0.0, std::numeric_limits<double>::infinity()};
constexpr ScaleRange known_scale{1.0, 1.0};

/** All points, a reach that falls from an eighth of the creature to its spacing. */
constexpr Refinement::Effort thorough{10000, 100, 0.5, 0.08, true};

SurfacePoints
surfaceOf(const Points& points)
{
  constexpr int neighbours = 12;
  return {std::make_shared<NearestPoints>(points, 1),
          pcl::kss::normalsOf(points, pcl::kss::neighbourhoodsOf(points, neighbours, 1),
                              1)};
}

/** Refines with all points of the clouds, which are in no order: any leading part of
 * them covers the cloud. */
Eigen::Matrix4d
refined(const Points& source,
        const Points& target,
        const Eigen::Matrix4d& start,
        const ScaleRange& scales = any_scale,
        const Refinement::Effort& effort = thorough)
{
  const SurfacePoints all_source = surfaceOf(source), all_target = surfaceOf(target);
  return Refinement(source, target, all_source, all_target, scales)
      .refine(Similarity::of(start), effort)
      .matrix();
}

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
    const Eigen::Matrix4d found = refined(source, target, start);
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
    const Eigen::Matrix4d found = refined(source, target, start);
    // The spacing is about 2 % of the diagonal; thousands of pairs average it out.
    EXPECT_LT(displacement(found, truth, source), 0.01);
    EXPECT_LT(rotationErrorDegrees(found, truth), 1.5);
    EXPECT_NEAR(1.0, scaleIn(found) / scaleIn(truth), 0.01);
  }
}

TEST(Refinement, SlidesAlongPlanes)
{
  // an object on a table ten times as large: all but one in twenty points hold it
  const Mesh table = panel({-2.0, -2.0, 0.0}, {4.0, 0.0, 0.0}, {0.0, 4.0, 0.0});
  const Mesh scene = together({table, ellipsoid({0.3, 0.2, 0.15}, {0.4, 0.25, 0.15})});
  const Points source = sampled(scene, 4000, 21), target = sampled(scene, 4000, 22);
  Eigen::Matrix4d start = Eigen::Matrix4d::Identity();
  start.topRightCorner<3, 1>() = Eigen::Vector3d(0.15, -0.1, 0.02);
  const auto lengthAfter = [&](bool on_planes) {
    const Refinement::Effort effort{4000, 12, 0.3, 0.1, true, on_planes};
    const Eigen::Matrix4d found = refined(source, target, start, known_scale, effort);
    return found.topRightCorner<3, 1>().norm();
  };
  EXPECT_GT(lengthAfter(false), 0.08);
  EXPECT_LT(lengthAfter(true), 0.02);
}

TEST(Refinement, OnPlanesAlignsSimilaritiesToo)
{
  const Points target = sampled(creature(), 2000, 3);
  std::mt19937 random(4);
  Refinement::Effort effort = thorough;
  effort.on_planes = true;
  for (int i = 0; i < 5; ++i) {
    const Eigen::Matrix4d truth = randomSimilarity(10 + i);
    const Points source =
        transformed(sampled(creature(), 2000, 5 + i), truth.inverse());
    const Eigen::Matrix4d start = turn(10.0, randomVector(random, 1.0)) * truth;
    const Eigen::Matrix4d found = refined(source, target, start, any_scale, effort);
    EXPECT_LT(displacement(found, truth, source), 0.01);
    EXPECT_NEAR(1.0, scaleIn(found) / scaleIn(truth), 0.01);
  }
}

TEST(PlanePulls, AskForTheMotionThatIsMissing)
{
  // exact correspondences on three faces of a corner
  std::mt19937 random(7);
  Similarity moved{
      1.0, turn(3.0, {1.0, 2.0, -1.0}).topLeftCorner<3, 3>(), {0.02, -0.01, 0.03}};
  for (int step = 0; step < 5; ++step) {
    pcl::kss::PlanePulls pulls;
    // what fills up the last vector has no weight
    constexpr int size = 300, filled = 304;
    pcl::kss::PlanePulls::Rows placed(3, filled), points(3, filled), normals(3, filled);
    Eigen::RowVectorXf weights = Eigen::RowVectorXf::Zero(filled);
    weights.head(size).setOnes();
    for (int i = 0; i < filled; ++i) {
      Eigen::Vector3f point = randomVector(random, 1.0).cast<float>();
      if (i < size)
        point[i % 3] = 0.0f;
      placed.col(i) = moved.affine() * point;
      points.col(i) = point;
      normals.col(i) = Eigen::Vector3f::Unit(i % 3);
    }
    pulls.add(placed, points, normals, weights);
    moved = pulls.moved(moved, pcl::kss::turnsOf(RotationAxis::ANY));
  }
  EXPECT_TRUE(moved.rotation.isIdentity(1e-5));
  EXPECT_LT(moved.translation.norm(), 1e-5);
  // nothing pulls: nothing moves
  EXPECT_EQ(moved.matrix(), pcl::kss::PlanePulls()
                                .moved(moved, pcl::kss::turnsOf(RotationAxis::ANY))
                                .matrix());
}

TEST(Refinement, TurnsAboutTheAxisAlone)
{
  const Points target = sampled(creature(), 500, 11);
  const Eigen::Matrix4d truth =
      similarity(Eigen::Quaterniond(Eigen::AngleAxisd(0.2, Eigen::Vector3d::UnitZ())),
                 1.1, {0.05, -0.02, 0.03});
  const Points source = transformed(target, truth.inverse());
  const SurfacePoints all_source = surfaceOf(source), all_target = surfaceOf(target);
  const Eigen::Matrix4d tilt =
      similarity(Eigen::Quaterniond(Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitX())),
                 1.0, {0.0, 0.0, 0.0});
  // from points to points even a tilted pose is turned upright
  const Refinement refinement(source, target, all_source, all_target, any_scale,
                              RotationAxis::Z);
  const Eigen::Matrix4d found =
      refinement.refine(Similarity::of(tilt), thorough).matrix();
  EXPECT_LT((found - truth).cwiseAbs().maxCoeff(), 1e-4);
  // towards planes one that is upright stays so
  Refinement::Effort on_planes = thorough;
  on_planes.on_planes = true;
  const Similarity upright =
      refinement.refine(Similarity::of(Eigen::Matrix4d::Identity()), on_planes);
  EXPECT_NEAR(1.0, upright.rotation(2, 2), 1e-12);
  EXPECT_LT((upright.matrix() - truth).cwiseAbs().maxCoeff(), 1e-3);
}

TEST(Refinement, KeepsTheScaleWhereItIsKnown)
{
  const Points target = sampled(creature(), 500, 11);
  const Points source = sampled(creature(), 500, 12);
  for (const double scale : {0.9, 1.0, 1.2}) {
    Eigen::Matrix4d start = turn(10.0, {1.0, 1.0, 0.0});
    start.topLeftCorner<3, 3>() *= scale;
    const Eigen::Matrix4d found = refined(source, target, start, known_scale);
    EXPECT_NEAR(scale, std::cbrt(found.topLeftCorner<3, 3>().determinant()), 1e-9);
    // a rotation, not a mirror's
    const Eigen::Matrix3d rotation = found.topLeftCorner<3, 3>() / scale;
    EXPECT_TRUE((rotation * rotation.transpose()).isIdentity(1e-9));
    // it has turned, though, as far as that scale lets it
    EXPECT_LT(rotationErrorDegrees(found, Eigen::Matrix4d::Identity()),
              scale == 1.0 ? 3.0 : 6.0);
  }
}

TEST(Refinement, KeepsTheScaleWithinItsBounds)
{
  const Points target = sampled(creature(), 1000, 13);
  const Points source = sampled(creature(), 1000, 14) / 1.2f;
  const Eigen::Matrix4d start = turn(5.0, {1.0, 0.0, 1.0});
  EXPECT_NEAR(1.2, scaleIn(refined(source, target, start, {1.0, 1.5})), 0.02);
  EXPECT_NEAR(1.1, scaleIn(refined(source, target, start, {0.8, 1.1})), 1e-9);
  EXPECT_NEAR(1.3, scaleIn(refined(source, target, start, {1.3, 1.6})), 1e-9);
}

TEST(Refinement, DoesNotShrinkUnderNoise)
{
  double bias = 0.0, one_sided_bias = 0.0;
  constexpr int rounds = 5;
  for (unsigned int i = 0; i < rounds; ++i) {
    const Points source = noisy(sampled(creature(), 1500, 20 + i), 0.08, 30 + i);
    const Points target = noisy(sampled(creature(), 1500, 40 + i), 0.08, 50 + i);
    const Eigen::Matrix4d found = refined(source, target, Eigen::Matrix4d::Identity());
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
  const Eigen::Matrix4d there = refined(a, b, start);
  const Eigen::Matrix4d back = refined(b, a, start.inverse());
  EXPECT_NEAR(1.0, scaleIn(there) * scaleIn(back), 1e-3);
  EXPECT_LT(displacement(back * there, Eigen::Matrix4d::Identity(), a), 2e-3);
}

TEST(Refinement, IsNotPulledByPartsWithoutACounterpart)
{
  // six tenths of the one on the whole other, and both cut from different sides
  std::mt19937 random(64);
  const Points whole = sampled(lump(), 2000, 65), other = sampled(lump(), 2000, 66);
  const Points cut = part(other, {1, 0, 0}, 0.6);
  const Points cut_elsewhere = part(whole, {-0.5f, 1, 0}, 0.7);
  const std::pair<const Points*, const Points*> pairs[] = {
      {&cut, &whole}, {&whole, &cut}, {&cut, &cut_elsewhere}};
  for (const auto& pair : pairs)
    for (int i = 0; i < 3; ++i) {
      const Eigen::Matrix4d start = turn(10.0, randomVector(random, 1.0));
      const Eigen::Matrix4d found =
          refined(*pair.first, *pair.second, start, known_scale);
      EXPECT_LT(displacement(found, Eigen::Matrix4d::Identity(), *pair.first), 0.01);
    }
}

TEST(Refinement, IsNotPulledByOutliers)
{
  const Points source = withOutliers(sampled(lump(), 1500, 67), 0.2, 68);
  const Points target = withOutliers(sampled(lump(), 1500, 69), 0.2, 70);
  const Eigen::Matrix4d found = refined(source, target, turn(10.0, {1.0, 1.0, 0.0}));
  EXPECT_LT(displacement(found, Eigen::Matrix4d::Identity(), source), 0.01);
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
    const double unit = scaleIn(placed);
    const Eigen::Matrix4d found = refined(source, target, start, any_scale,
                                          {1000, 100, 0.5 * unit, 0.08 * unit, true});
    EXPECT_GT(found.determinant(), 0.0) << seed;
    EXPECT_LT(displacement(found, placed * truth, source), 0.02) << seed;
  }
}

TEST(Refinement, StopsWhenToldTo)
{
  const Points target = sampled(creature(), 500, 80);
  const Points source = sampled(creature(), 500, 81);
  const Eigen::Matrix4d start = turn(20.0, {1.0, 0.0, 0.0});
  const auto after = [&](int iterations, const Eigen::Matrix4d& pose) {
    return refined(source, target, pose, any_scale, {500, iterations, 0.2, 0.2, true});
  };
  EXPECT_EQ(start, after(0, start));
  // while the reach stays, one step at a time is the same as several at once, but for
  // what is remembered of nearest points that are nearly the nearest
  Eigen::Matrix4d stepped = start;
  for (int i = 0; i < 5; ++i)
    stepped = after(1, stepped);
  EXPECT_TRUE(stepped.isApprox(after(5, start), 1e-3));
  EXPECT_FALSE(stepped.isApprox(after(4, start), 1e-3));
  EXPECT_FALSE(stepped.isApprox(start, 1e-2));
  // and where nothing moves any more there are no further ones
  EXPECT_TRUE(after(2000, start).isApprox(after(2000, after(2000, start)), 1e-3));
}

TEST(Refinement, ReachesAsFarAsItIsTold)
{
  // three spacings off: a narrow reach is caught by whatever lies near
  const Points target = sampled(lump(), 1000, 82), source = sampled(lump(), 1000, 83);
  const Eigen::Matrix4d start = turn(30.0, {1.0, 2.0, 0.5});
  const auto error = [&](double widest) {
    return displacement(
        refined(source, target, start, known_scale, {1000, 40, widest, 0.05, true}),
        Eigen::Matrix4d::Identity(), source);
  };
  EXPECT_LT(error(0.5), 0.01);
  EXPECT_GT(error(0.005), 0.02);
}

TEST(Refinement, MakesDoWithSomeOfThePoints)
{
  const Points target = sampled(creature(), 2000, 90);
  const Points source = sampled(creature(), 2000, 91);
  const Eigen::Matrix4d start = turn(10.0, {0.0, 0.0, 1.0});
  for (const bool exact : {true, false}) {
    const Eigen::Matrix4d found =
        refined(source, target, start, any_scale, {400, 30, 0.5, 0.08, exact});
    EXPECT_LT(displacement(found, Eigen::Matrix4d::Identity(), source),
              exact ? 0.02 : 0.03);
    EXPECT_NE(found,
              refined(source, target, start, any_scale, {2000, 30, 0.5, 0.08, exact}));
  }
}

} // namespace
