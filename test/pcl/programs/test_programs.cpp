/*
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * What PCL's programs ask of a registration, call by call, with KSSICP in its place:
 * docs/pcl_programs.md.
 */

#include "pairs.h"

#include <cmath>
#include <limits>
#include <string>

namespace {

using namespace kss_test;
using Cloud = pcl::PointCloud<pcl::PointXYZ>;
using ICP = pcl::IterativeClosestPoint<pcl::PointXYZ, pcl::PointXYZ>;
using KSSICP = pcl::KSSICP<pcl::PointXYZ, pcl::PointXYZ>;
using Estimation =
    pcl::registration::TransformationEstimation<pcl::PointXYZ, pcl::PointXYZ>;

void
expectReason(const KSSICP& registration, const std::string& part)
{
  EXPECT_FALSE(registration.hasConverged());
  EXPECT_NE(std::string::npos, registration.getFailureReason().find(part))
      << registration.getFailureReason();
}

/** iterative_closest_point: random points, and the same points 0.7 farther on. */
template <typename Registration>
void
alignShifted(Registration& icp, int size, unsigned int seed)
{
  const Points points = (2.0f * scattered(size, seed).array() - 1.0f).matrix();
  const auto cloud_in = cloudOf<pcl::PointXYZ>(points);
  const auto cloud_out = pcl::make_shared<Cloud>(*cloud_in);
  for (pcl::PointXYZ& point : *cloud_out)
    point.x += 0.7f;
  icp.setInputSource(cloud_in);
  icp.setInputTarget(cloud_out);
  Cloud aligned;
  icp.align(aligned);
  EXPECT_EQ(cloud_in->size(), aligned.size());
}

template <typename Registration>
void
expectShift(Registration& icp)
{
  EXPECT_TRUE(icp.hasConverged());
  EXPECT_LT(icp.getFitnessScore(), 1e-10);
  Eigen::Matrix4f shift = Eigen::Matrix4f::Identity();
  shift(0, 3) = 0.7f;
  EXPECT_LT((icp.getFinalTransformation() - shift).norm(), 1e-5f);
}

TEST(Programs, IterativeClosestPoint)
{
  for (unsigned int seed = 1; seed < 4; ++seed)
    for (const int size : {50, 100, 1000}) {
      KSSICP registration;
      alignShifted(registration, size, seed);
      expectShift(registration);
    }
}

/** Five points have no surface, but they are a copy of the others. */
TEST(Programs, IterativeClosestPointOfFivePoints)
{
  for (unsigned int seed = 1; seed < 10; ++seed)
    for (const int size : {5, 12, 20, 30}) {
      KSSICP registration;
      alignShifted(registration, size, seed);
      expectShift(registration);
    }
}

/** interactive_icp: a moved copy of a model, an iteration whenever a key is pressed,
 * the source its own output. */
void
alignAtEachKey(const Points& model, const Estimation::Ptr& estimation = nullptr)
{
  const auto cloud_in = cloudOf<pcl::PointXYZ>(model);
  Eigen::Matrix4d moved = turn(22.5, Eigen::Vector3d::UnitZ());
  moved(2, 3) = 0.15 * diagonalOf(model);
  const auto cloud_icp = cloudOf<pcl::PointXYZ>(transformed(model, moved));
  const Points before = pointsOf(*cloud_icp);
  KSSICP icp;
  if (estimation)
    icp.setTransformationEstimation(estimation);
  icp.setMaximumIterations(1);
  icp.setInputSource(cloud_icp);
  icp.setInputTarget(cloud_in);
  Eigen::Matrix4d all = Eigen::Matrix4d::Identity();
  for (int key = 0; key < 4; ++key) {
    icp.align(*cloud_icp);
    ASSERT_TRUE(icp.hasConverged()) << "key " << key << ": " << icp.getFailureReason();
    EXPECT_LT(icp.getFitnessScore(), std::pow(1e-5 * diagonalOf(model), 2));
    all = poseFrom(icp) * all;
    EXPECT_LT(displacement(all, moved.inverse(), before), 1e-6);
    expectTransformed(*cloud_icp, *cloudOf<pcl::PointXYZ>(before), all);
  }
}

TEST(Programs, InteractiveICP)
{
  alignAtEachKey(sampled(creature(), 1500, 1));
  // the more points and the farther out, the more errors a rounded pose is off
  const Eigen::Vector3f far(10.0f, -3.0f, 5.0f);
  for (unsigned int seed = 2; seed < 5; ++seed)
    alignAtEachKey(sampled(creature(), 10000, seed).colwise() + far);
  // and with ICP's own estimation
  using PointToPoint =
      pcl::registration::TransformationEstimationSVD<pcl::PointXYZ, pcl::PointXYZ>;
  alignAtEachKey(sampled(creature(), 1500, 5), pcl::make_shared<PointToPoint>());
}

/** template_alignment: several templates on a depth image, of which the fitness score
 * tells the best one. */
class TemplateAlignment : public ::testing::Test {
protected:
  struct Result {
    double fitness = std::numeric_limits<double>::max();
    bool converged = false;
    Eigen::Matrix4d pose;
  };

  TemplateAlignment()
  {
    const auto image = viewFrom(front_, 1);
    registration_.setMaxCorrespondenceDistance(longest_);
    registration_.setMaximumIterations(500);
    registration_.setInputTarget(cloudOf<pcl::PointXYZ>(noisy(image, 0.005, 2)));
  }

  static Points
  viewFrom(const Eigen::Vector3f& direction, unsigned int seed)
  {
    return part(sampled(creature(), 2500, seed), direction, 0.8);
  }

  Result
  align(const Points& points)
  {
    registration_.setInputSource(cloudOf<pcl::PointXYZ>(points));
    Cloud aligned;
    registration_.align(aligned);
    return {registration_.getFitnessScore(longest_), registration_.hasConverged(),
            poseFrom(registration_)};
  }

  const Eigen::Vector3f front_{0.3f, 1.0f, 0.4f};
  const double longest_ = 0.2;
  KSSICP registration_;
};

TEST_F(TemplateAlignment, FindsTheTemplateThatShowsMostOfTheImage)
{
  Result best;
  unsigned int best_view = 0;
  for (unsigned int view = 0; view < 6; ++view) {
    const Eigen::Affine3d round(turn(60.0 * (view - 2.0), {0.2, 0.1, 1.0}));
    const Eigen::Vector3f from = (round * front_.cast<double>()).cast<float>();
    const Eigen::Matrix4d truth = randomRigid(10 + view);
    const Points points = transformed(viewFrom(from, 20 + view), truth.inverse());
    const Result result = align(points);
    EXPECT_TRUE(result.converged) << view << ": " << registration_.getFailureReason();
    EXPECT_LT(displacement(result.pose, truth, points), 0.005) << view;
    if (result.fitness < best.fitness) {
      best = result;
      best_view = view;
    }
  }
  EXPECT_EQ(2, best_view);
}

/** Their fitness is that of the few points near the image: it may well be low. */
TEST_F(TemplateAlignment, RefusesTemplatesOfOtherThings)
{
  for (const Mesh& other : {cross(), lump()})
    EXPECT_FALSE(align(sampled(other, 2000, 30)).converged);
}

/** alignment_prerejective: an object somewhere in a scene. */
class AlignmentPrerejective : public ::testing::Test {
protected:
  AlignmentPrerejective()
  {
    const Points object = sampled(creature(), 1000, 21);
    // a corner of a room with furniture and other things
    const Mesh room = together({panel({-4, -4, -2}, {8, 0, 0}, {0, 8, 0}),
                                panel({-4, 4, -2}, {8, 0, 0}, {0, 0, 4}),
                                box({-2.5, -1.5, -1.5}, {0.6, 0.4, 0.5}),
                                box({2.4, 2.0, -1.2}, {0.3, 0.7, 0.8}),
                                ellipsoid({1.5, -2.5, -1.4}, {0.7, 0.7, 0.6}),
                                ellipsoid({-2.2, 2.3, -1.5}, {0.4, 0.9, 0.5})});
    const Points things = sampled(room, 11000, 22),
                 placed = sampled(creature(), 1000, 23);
    Points scene(3, things.cols() + placed.cols());
    scene << things, placed;
    pair_ = pairOf(object, scene, randomRigid(24));
    registration_.setInputSource(pair_.source);
    registration_.setInputTarget(pair_.target);
    registration_.setMaximumIterations(50000);
    registration_.setMaxCorrespondenceDistance(2.5f * 0.1f);
  }

  Pair<> pair_;
  KSSICP registration_;
  Cloud aligned_;
};

TEST_F(AlignmentPrerejective, FindsAnObjectWhoseScaleIsKnown)
{
  registration_.setScaleEstimation(false);
  registration_.align(aligned_);
  EXPECT_TRUE(registration_.hasConverged()) << registration_.getFailureReason();
  expectRight(registration_, pair_);
  expectTransformed(aligned_, *pair_.source, registration_.getFinalTransformation());
}

TEST_F(AlignmentPrerejective, AsksWhetherTheScaleIsKnown)
{
  registration_.align(aligned_);
  expectReason(registration_, "at scale 1, as an object in a scene");
  // in vain where it is said to be another
  registration_.setScaleRange(1.5, 3.0);
  registration_.align(aligned_);
  expectReason(registration_, "at the best pose");
}

} // namespace
