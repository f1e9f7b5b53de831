/*
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * The class for many scans.
 */

#include "multiview/body.h"

#include <pcl/registration/kss_multiview.h>

#include <pcl/point_types.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

namespace {

using pcl::registration::KSSMultiview;

/** Scans of two bodies: three of the one and two of the other. */
class Multiview : public testing::Test {
protected:
  Multiview()
  {
    for (const made_up::BodyScan& scan : made_up::scansOfTwoBodies(1500)) {
      T_scan_body_.push_back(scan.T_scan_body);
      points_.push_back(scan.points);
    }
    settings_.device = "host";
  }

  /** A scan whose points are of any type. */
  template <typename PointT>
  typename pcl::PointCloud<PointT>::Ptr
  cloudOf(std::size_t scan) const
  {
    const auto cloud = pcl::make_shared<pcl::PointCloud<PointT>>();
    for (Eigen::Index i = 0; i < points_[scan].cols(); ++i) {
      PointT point;
      point.getVector3fMap() = points_[scan].col(i).cast<float>();
      cloud->push_back(point);
    }
    return cloud;
  }

  /** The scans of the second body. */
  template <typename PointT>
  void
  addTwo(KSSMultiview<PointT>& multiview) const
  {
    multiview.setSettings(settings_);
    multiview.addScan(cloudOf<PointT>(3));
    multiview.addScan(cloudOf<PointT>(4));
  }

  /** How far the points of a scan are off, at most, in the frame of another one. */
  double
  errorOf(const Eigen::Matrix4d& found, std::size_t scan, std::size_t first) const
  {
    const Eigen::Matrix4d truth = T_scan_body_[first] * T_scan_body_[scan].inverse();
    return ((found - truth) * points_[scan].colwise().homogeneous())
        .colwise()
        .norm()
        .maxCoeff();
  }

  std::vector<Eigen::Matrix4d> T_scan_body_;
  std::vector<Eigen::Matrix3Xd> points_;
  pcl::kss::Settings settings_;
};

using Groups = std::vector<std::vector<std::size_t>>;

TEST_F(Multiview, FindsGroupsAndPoses)
{
  KSSMultiview<pcl::PointXYZ> multiview;
  settings_.estimate_scale = true; // is known all the same
  multiview.setSettings(settings_);
  std::set<std::string> stages;
  multiview.setProgressCallback([&](const std::string& stage, double done) {
    stages.insert(stage);
    EXPECT_GE(done, 0.0);
    EXPECT_LE(done, 1.0);
  });
  for (std::size_t i = 0; i < 5; ++i)
    EXPECT_EQ(i, multiview.addScan(cloudOf<pcl::PointXYZ>(i)));
  ASSERT_TRUE(multiview.align()) << multiview.getFailureReason();
  EXPECT_EQ("", multiview.getFailureReason());
  ASSERT_EQ((Groups{{0, 1, 2}, {3, 4}}), multiview.getGroups());
  EXPECT_EQ(10u, multiview.getPairs().size());
  EXPECT_EQ(5u, multiview.getResult().scans.size());
  EXPECT_TRUE(multiview.getPose(0).isIdentity(1e-12));
  EXPECT_TRUE(multiview.getPose(3).isIdentity(1e-12));
  EXPECT_LT(errorOf(multiview.getPose(1), 1, 0), 0.05);
  EXPECT_LT(errorOf(multiview.getPose(2), 2, 0), 0.05);
  EXPECT_LT(errorOf(multiview.getPose(4), 4, 3), 0.05);
  EXPECT_THROW(multiview.getPose(5), std::out_of_range);
  for (std::size_t i = 0; i < 5; ++i)
    EXPECT_NEAR(1.0, multiview.getPose(i).determinant(), 1e-9);
  EXPECT_TRUE(multiview.getSettings().estimate_scale);
  EXPECT_EQ(1u, stages.count("scans"));
  EXPECT_EQ(1u, stages.count("pairs"));

  pcl::PointCloud<pcl::PointXYZ> merged;
  multiview.getMergedCloud(1, merged);
  ASSERT_EQ(3000u, merged.size());
  for (Eigen::Index i = 0; i < 1500; ++i) {
    const Eigen::Vector4d placed =
        multiview.getPose(4) * points_[4].col(i).homogeneous();
    EXPECT_LT((merged[i].getVector3fMap() - points_[3].col(i).cast<float>()).norm(),
              1e-5);
    EXPECT_LT(
        (merged[1500 + i].getVector3fMap() - placed.head<3>().cast<float>()).norm(),
        1e-5);
  }
  EXPECT_THROW(multiview.getMergedCloud(2, merged), std::out_of_range);
}

TEST_F(Multiview, KeepsColours)
{
  KSSMultiview<pcl::PointXYZRGB> multiview;
  for (const std::size_t scan : {3, 4}) {
    const auto cloud = cloudOf<pcl::PointXYZRGB>(scan);
    for (std::size_t i = 0; i < cloud->size(); ++i) {
      (*cloud)[i].r = static_cast<std::uint8_t>(i);
      (*cloud)[i].b = static_cast<std::uint8_t>(scan);
    }
    multiview.addScan(cloud);
  }
  multiview.setSettings(settings_);
  ASSERT_TRUE(multiview.align()) << multiview.getFailureReason();
  ASSERT_EQ((Groups{{0, 1}}), multiview.getGroups());
  pcl::PointCloud<pcl::PointXYZRGB> merged;
  multiview.getMergedCloud(0, merged);
  ASSERT_EQ(3000u, merged.size());
  for (std::size_t i = 0; i < merged.size(); ++i) {
    EXPECT_EQ(static_cast<std::uint8_t>(i % 1500), merged[i].r);
    EXPECT_EQ(i < 1500 ? 3 : 4, merged[i].b);
  }
}

TEST_F(Multiview, TurnsNormals)
{
  KSSMultiview<pcl::PointNormal> multiview;
  multiview.setSettings(settings_);
  std::vector<Eigen::Vector3f> normals;
  for (const std::size_t scan : {3, 4}) {
    const auto cloud = cloudOf<pcl::PointNormal>(scan);
    const Eigen::Vector3d center = T_scan_body_[scan].topRightCorner<3, 1>();
    for (std::size_t i = 0; i < cloud->size(); ++i) {
      const Eigen::Vector3d outwards = points_[scan].col(i) - center;
      (*cloud)[i].getNormalVector3fMap() = outwards.normalized().cast<float>();
      normals.push_back(outwards.normalized().cast<float>());
    }
    multiview.addScan(cloud);
  }
  ASSERT_TRUE(multiview.align()) << multiview.getFailureReason();
  ASSERT_EQ((Groups{{0, 1}}), multiview.getGroups());
  pcl::PointCloud<pcl::PointNormal> merged;
  multiview.getMergedCloud(0, merged);
  ASSERT_EQ(3000u, merged.size());
  const Eigen::Matrix3f turn = multiview.getPose(1).topLeftCorner<3, 3>().cast<float>();
  EXPECT_FALSE(turn.isIdentity(0.1f));
  for (std::size_t i = 0; i < 3000; ++i) {
    const Eigen::Vector3f turned = i < 1500 ? normals[i] : turn * normals[i];
    EXPECT_LT((merged[i].getNormalVector3fMap() - turned).norm(), 1e-5);
  }
}

TEST_F(Multiview, LeavesOutWhatIsNoPoint)
{
  KSSMultiview<pcl::PointXYZ> multiview;
  multiview.setSettings(settings_);
  const float nan = std::numeric_limits<float>::quiet_NaN(),
              infinity = std::numeric_limits<float>::infinity();
  for (const std::size_t scan : {3, 4}) {
    const auto cloud = cloudOf<pcl::PointXYZ>(scan);
    for (const std::size_t i : {0, 700, 1500})
      cloud->insert(cloud->begin() + i, pcl::PointXYZ(nan, infinity, 0.0f));
    cloud->is_dense = false;
    multiview.addScan(cloud);
  }
  ASSERT_TRUE(multiview.align()) << multiview.getFailureReason();
  ASSERT_EQ((Groups{{0, 1}}), multiview.getGroups());
  EXPECT_LT(errorOf(multiview.getPose(1), 4, 3), 0.05);
  pcl::PointCloud<pcl::PointXYZ> merged;
  multiview.getMergedCloud(0, merged);
  EXPECT_EQ(3006u, merged.size()) << "as many as there were";
  EXPECT_FALSE(merged.is_dense);
}

TEST_F(Multiview, ScansThatCannotBeUsedAreTold)
{
  KSSMultiview<pcl::PointNormal> multiview;
  multiview.addScan(nullptr);
  addTwo(multiview); // normals that are not known, too
  multiview.addScan(pcl::make_shared<pcl::PointCloud<pcl::PointNormal>>());
  ASSERT_NO_THROW(EXPECT_TRUE(multiview.align()));
  ASSERT_EQ((Groups{{1, 2}, {0}, {3}}), multiview.getGroups());
  EXPECT_LT(errorOf(multiview.getPose(2), 4, 3), 0.05);
  pcl::PointCloud<pcl::PointNormal> merged;
  for (const std::size_t group : {1, 2}) {
    const std::size_t scan = multiview.getGroups()[group].front();
    EXPECT_NE("", multiview.getResult().scans[scan].failure.reason);
    EXPECT_TRUE(multiview.getPose(scan).isIdentity());
    merged.resize(5);
    ASSERT_NO_THROW(multiview.getMergedCloud(group, merged));
    EXPECT_TRUE(merged.empty());
  }
}

TEST_F(Multiview, CanBeUsedAgain)
{
  KSSMultiview<pcl::PointXYZ> multiview;
  ASSERT_TRUE(multiview.align()) << "no scans";
  EXPECT_TRUE(multiview.getGroups().empty());
  EXPECT_TRUE(multiview.getPairs().empty());

  addTwo(multiview);
  ASSERT_TRUE(multiview.align());
  const Eigen::Matrix4d pose = multiview.getPose(1);
  EXPECT_LT(errorOf(pose, 4, 3), 0.05);
  multiview.clear();
  EXPECT_TRUE(multiview.getGroups().empty());
  EXPECT_THROW(multiview.getPose(0), std::out_of_range);
  addTwo(multiview);
  ASSERT_TRUE(multiview.align());
  EXPECT_EQ(pose, multiview.getPose(1));
}

TEST_F(Multiview, RefusesSettingsThatAreOutOfBounds)
{
  KSSMultiview<pcl::PointXYZ> multiview;
  settings_.sample_points = 0;
  settings_.icp_points = 7000;
  multiview.setSettings(settings_);
  EXPECT_EQ(pcl::kss::Settings().sample_points, multiview.getSettings().sample_points);
  EXPECT_EQ(7000u, multiview.getSettings().icp_points);
}

} // namespace
