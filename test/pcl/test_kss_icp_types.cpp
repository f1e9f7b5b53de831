/*
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * KSSICP for other points than PointXYZ, in double precision, far from the origin, and
 * in the hands of PCL's own users of a Registration.
 */

#include "pairs.h"

#include <pcl/registration/elch.h>
#include <pcl/registration/incremental_registration.h>
#include <pcl/registration/meta_registration.h>
#include <pcl/registration/transformation_estimation_point_to_plane_lls.h>

namespace {

using namespace kss_test;
using pcl::PointNormal;
using pcl::PointXYZ;

TEST(PointTypes, HaveTheirNormalsTurnedAndNothingElse)
{
  const auto pair = pairOf<PointNormal>(randomSimilarity(2));
  std::mt19937 random(3);
  for (PointNormal& point : *pair.source) {
    point.getNormalVector3fMap() = randomVector(random, 1.0).normalized().cast<float>();
    point.curvature = point.x;
  }
  makeNaN((*pair.source)[7]);
  pcl::KSSICP<PointNormal, PointNormal> registration;
  makeQuick(registration);
  setClouds(registration, pair);
  pcl::PointCloud<PointNormal> output;
  registration.align(output);
  EXPECT_TRUE(registration.hasConverged());
  ASSERT_GT(std::abs(registration.getScale() - 1.0), 0.1); // else it would show nothing
  expectTransformed(output, *pair.source, registration.getFinalTransformation());
  const Eigen::Matrix3f rotation =
      registration.getFinalTransformation().topLeftCorner<3, 3>() /
      static_cast<float>(registration.getScale());
  for (std::size_t i = 0; i < output.size(); ++i) {
    const Eigen::Vector3f before = (*pair.source)[i].getNormalVector3fMap();
    const Eigen::Vector3f after = output[i].getNormalVector3fMap();
    ASSERT_NEAR(1.0f, after.norm(), 1e-5f);
    if (i != 7) {
      ASSERT_TRUE(after.isApprox(rotation * before, 1e-5f));
    }
    else {
      EXPECT_EQ(before, after);
    }
    ASSERT_TRUE(output[i].curvature == (*pair.source)[i].curvature ||
                std::isnan(output[i].curvature));
  }
}

TEST(PointTypes, KeepTheirOtherFields)
{
  const auto coloured = pairOf<pcl::PointXYZRGB>(randomSimilarity(4));
  for (std::size_t i = 0; i < coloured.source->size(); ++i)
    (*coloured.source)[i].rgba = static_cast<std::uint32_t>(i * 7919);
  pcl::KSSICP<pcl::PointXYZRGB, pcl::PointXYZRGB> registration;
  makeQuick(registration);
  setClouds(registration, coloured);
  pcl::PointCloud<pcl::PointXYZRGB> output;
  registration.align(output);
  EXPECT_TRUE(registration.hasConverged());
  for (std::size_t i = 0; i < output.size(); ++i)
    ASSERT_EQ(i * 7919, output[i].rgba);

  const auto intense = pairOf<pcl::PointXYZI>(randomSimilarity(5));
  for (std::size_t i = 0; i < intense.source->size(); ++i)
    (*intense.source)[i].intensity = static_cast<float>(i);
  pcl::KSSICP<pcl::PointXYZI, pcl::PointXYZI, double> precise;
  makeQuick(precise);
  setClouds(precise, intense);
  pcl::PointCloud<pcl::PointXYZI> precise_output;
  precise.align(precise_output);
  EXPECT_TRUE(precise.hasConverged());
  expectRight(precise, intense);
  for (std::size_t i = 0; i < precise_output.size(); ++i)
    ASSERT_EQ(static_cast<float>(i), precise_output[i].intensity);
}

TEST(PointTypes, LetPointToPlaneEstimationHaveItsNormals)
{
  // an ellipsoid's normals are known
  const Eigen::Vector3d radii(1.0, 0.7, 0.4);
  const Mesh mesh = ellipsoid({0, 0, 0}, radii);
  auto pair = pairOf<PointNormal>(randomRigid(6), 6, mesh);
  for (PointNormal& point : *pair.target)
    point.getNormalVector3fMap() = point.getVector3fMap()
                                       .cwiseQuotient(radii.cwiseAbs2().cast<float>())
                                       .normalized();
  pcl::KSSICP<PointNormal, PointNormal> registration;
  makeQuick(registration);
  registration.setScaleEstimation(false);
  registration.setTransformationEstimation(
      pcl::make_shared<pcl::registration::TransformationEstimationPointToPlaneLLS<
          PointNormal, PointNormal>>());
  setClouds(registration, pair);
  pcl::PointCloud<PointNormal> output;
  registration.align(output);
  // The ellipsoid has four poses; on its surface the source lies in all of them.
  double off = 0.0;
  for (const PointNormal& point : output)
    off += std::abs(point.getVector3fMap().cwiseQuotient(radii.cast<float>()).norm() -
                    1.0) /
           output.size();
  EXPECT_LT(off, 0.01);
}

/** The pose found for a pair that is the same cloud twice, one of them moved; scaled by
 * a unit, each shifted to a place of its own. */
template <typename Scalar>
double
errorIn(double unit, double diagonals)
{
  const Points target = sampled(creature(), 1500, 7);
  const double shift = diagonals * diagonalOf(target);
  Eigen::Matrix4d units = Eigen::Matrix4d::Identity();
  units.topLeftCorner<3, 3>() *= unit;
  const auto shifted = [&](double x, double y, double z) {
    return similarity(Eigen::Quaterniond::Identity(), 1.0,
                      shift * Eigen::Vector3d(x, y, z));
  };
  const Eigen::Matrix4d rigid = randomRigid(8);
  const Eigen::Matrix4d to_source = units * shifted(0.6, -0.7, 0.4) * rigid.inverse();
  const Eigen::Matrix4d to_target = units * shifted(-0.5, 0.5, 0.7);
  Pair<PointXYZ> pair{cloudOf<PointXYZ>(transformed(target, to_source)),
                      cloudOf<PointXYZ>(transformed(target, to_target)),
                      to_target * to_source.inverse()};
  pcl::KSSICP<PointXYZ, PointXYZ, Scalar> registration;
  makeQuick(registration);
  registration.setScaleEstimation(false);
  setClouds(registration, pair);
  pcl::PointCloud<PointXYZ> output;
  registration.align(output);
  EXPECT_TRUE(registration.hasConverged()) << registration.getFailureReason();
  const Points source = pointsOf(*pair.source);
  // of the output, and of the matrix that is to be applied to other things
  const Points expected = transformed(source, pair.truth);
  const double off = (pointsOf(output) - expected).template cast<double>().norm() /
                     std::sqrt(1500.0) / diagonalOf(source);
  return std::max(off, displacement(poseFrom(registration), pair.truth, source));
}

TEST(Rounding, IsAllThatTheUnitChanges)
{
  // The places are a few diagonals: floats round to 1e-6 of it, matrices likewise.
  for (const double unit : {1e-3, 1.0, 1e3}) {
    EXPECT_LT(errorIn<float>(unit, 1.0), 2e-5) << unit;
    EXPECT_LT(errorIn<double>(unit, 1.0), 2e-6) << unit;
  }
}

TEST(Rounding, IsAllThatThePlaceChanges)
{
  // At 1000 diagonals a float coordinate is off by up to 3e-5 of the diagonal. A double
  // matrix averages that over the points, while its output has to be rounded, too.
  EXPECT_LT(errorIn<double>(1.0, 1000.0), 1e-4);
  // A float matrix rounds a rotation's entries to 6e-8, which that lever makes 1e-4 of
  // the diagonal, once for each of some ten to twenty iterations.
  EXPECT_LT(errorIn<float>(1.0, 1000.0), 3e-3);
  EXPECT_LT(errorIn<double>(1e-3, 1000.0), 1e-4);
  EXPECT_LT(errorIn<double>(1e3, 1000.0), 1e-4);
}

TEST(Users, IncrementalRegistrationChainsScans)
{
  const auto registration = pcl::make_shared<pcl::KSSICP<PointXYZ, PointXYZ>>();
  makeQuick(*registration);
  registration->setScaleEstimation(false);
  pcl::registration::IncrementalRegistration<PointXYZ> incremental;
  incremental.setRegistration(registration);
  // scan i is the creature seen from pose i
  std::vector<Eigen::Matrix4d> poses{Eigen::Matrix4d::Identity(), randomRigid(9),
                                     randomRigid(10)};
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const auto pair = pairOf(poses[i], 11 + i);
    ASSERT_TRUE(incremental.registerCloud(pair.source)) << i;
    EXPECT_LT(displacement(incremental.getAbsoluteTransform().cast<double>(), poses[i],
                           pointsOf(*pair.source)),
              0.02);
  }
  // a scan of something else is refused, and changes nothing
  const Eigen::Matrix4f before = incremental.getAbsoluteTransform();
  EXPECT_FALSE(
      incremental.registerCloud(cloudOf<PointXYZ>(sampled(cross(), 1500, 14))));
  EXPECT_EQ(before, incremental.getAbsoluteTransform());
}

TEST(Users, MetaRegistrationCollectsScans)
{
  const auto registration = pcl::make_shared<pcl::KSSICP<PointXYZ, PointXYZ>>();
  makeQuick(*registration);
  registration->setScaleEstimation(false);
  pcl::registration::MetaRegistration<PointXYZ> meta;
  meta.setRegistration(registration);
  std::size_t points = 0;
  for (unsigned int i = 0; i < 3; ++i) {
    const Eigen::Matrix4d pose =
        i == 0 ? Eigen::Matrix4d(Eigen::Matrix4d::Identity()) : randomRigid(15 + i);
    const auto pair = pairOf(pose, 15 + i);
    ASSERT_TRUE(meta.registerCloud(pair.source)) << i;
    EXPECT_LT(displacement(meta.getAbsoluteTransform().cast<double>(), pose,
                           pointsOf(*pair.source)),
              0.02);
    points += pair.source->size();
  }
  EXPECT_EQ(points, meta.getMetaCloud()->size());
}

TEST(Users, ELCHClosesALoop)
{
  const auto registration = pcl::make_shared<pcl::KSSICP<PointXYZ, PointXYZ>>();
  makeQuick(*registration);
  registration->setScaleEstimation(false);
  pcl::registration::ELCH<PointXYZ> elch;
  elch.setReg(registration);
  // Four scans of one creature; half way round, the poses have gone astray. ELCH joins
  // the scans next to each end before it registers the ends.
  const Eigen::Matrix4d drift = turn(50.0, {0.2, 0.0, 1.0});
  for (unsigned int i = 0; i < 4; ++i)
    elch.addPointCloud(cloudOf<PointXYZ>(
        transformed(sampled(creature(), 1000, 20 + i),
                    i < 2 ? Eigen::Matrix4d(Eigen::Matrix4d::Identity()) : drift)));
  elch.setLoopStart(0);
  elch.setLoopEnd(3);
  elch.compute();
  EXPECT_TRUE(registration->hasConverged());
  EXPECT_LT(
      rotationErrorDegrees(elch.getLoopTransform().cast<double>(), drift.inverse()),
      2.0);
}

} // namespace
