/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "multiview/made_up_scans.h"
#include "multiview/pose_graph.h"

#include <gtest/gtest.h>

#include <numeric>

using namespace pcl::kss;

namespace {

PoseLink
linkOf(const made_up::Scans& scans,
       std::size_t source,
       std::size_t target,
       const Eigen::Matrix4d& pose,
       double error)
{
  PoseLink link;
  link.source = source;
  link.target = target;
  link.transformation = pose;
  link.information =
      informationOfDisplacement(scans.descriptions[source], pose) / (error * error);
  return link;
}

std::vector<std::size_t>
allOf(const made_up::Scans& scans)
{
  std::vector<std::size_t> all(scans.poses.size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

std::vector<StoredPose>
started(made_up::Scans& scans, double angle, double shift)
{
  std::vector<StoredPose> poses = {scans.poses[0]};
  for (std::size_t i = 1; i < scans.poses.size(); ++i)
    poses.push_back(scans.disturbed(scans.poses[i], angle, shift));
  return poses;
}

TEST(PoseGraph, FindsPosesThatLinksAgreeOn)
{
  made_up::Scans scans(6);
  std::vector<PoseLink> links;
  for (std::size_t i = 0; i < 6; ++i)
    links.push_back(
        linkOf(scans, i, (i + 1) % 6, scans.relative(i, (i + 1) % 6), 0.01));
  std::vector<StoredPose> poses = started(scans, 0.2, 0.5);
  solvePoses(scans.descriptions, allOf(scans), links, poses);
  for (std::size_t i = 1; i < 6; ++i)
    EXPECT_LT(scans.error(0, i, poses), 1e-6) << i;
  EXPECT_TRUE(poses[0].isApprox(scans.poses[0], 1e-12)); // the first one stays
}

TEST(PoseGraph, SpreadsTheErrorOfALoopByHowPreciseItsLinksAre)
{
  made_up::Scans scans(3);
  for (auto& pose : scans.poses)
    pose.setIdentity();
  for (auto& scan : scans.descriptions)
    scan.centroid.setZero(); // or turns would take some of the error
  Eigen::Matrix4d off = Eigen::Matrix4d::Identity();
  off(0, 3) = 0.3;
  const std::vector<PoseLink> links = {
      linkOf(scans, 1, 0, Eigen::Matrix4d::Identity(), 0.1),
      linkOf(scans, 2, 1, Eigen::Matrix4d::Identity(), 0.1),
      linkOf(scans, 2, 0, off, 0.2)};
  std::vector<StoredPose> poses = started(scans, 0.0, 0.0);
  solvePoses(scans.descriptions, allOf(scans), links, poses);
  // errors of 0.1, 0.1 and 0.2: variances of 1, 1 and 4 share 0.3 out as 1 : 1 : 4;
  // the loss leaves that to a few per cent
  EXPECT_NEAR(poses[1](0, 3), 0.05, 0.003);
  EXPECT_NEAR(poses[2](0, 3), 0.10, 0.006);
}

TEST(PoseGraph, GivesALinkThatIsFarOffNoSay)
{
  made_up::Scans scans(5);
  std::vector<PoseLink> links;
  for (std::size_t i = 0; i < 5; ++i)
    for (std::size_t j = 0; j < i; ++j)
      links.push_back(linkOf(scans, i, j, scans.relative(i, j), 0.01));
  links[0].transformation = scans.disturbed(links[0].transformation, 0.5, 1.0);
  std::vector<StoredPose> poses = started(scans, 0.02, 0.05);
  solvePoses(scans.descriptions, allOf(scans), links, poses);
  for (std::size_t i = 1; i < 5; ++i)
    EXPECT_LT(scans.error(0, i, poses), 0.01) << i;
}

TEST(PoseGraph, LeavesDirectionsThatNothingDetermines)
{
  made_up::Scans scans(2);
  PoseLink link = linkOf(scans, 1, 0, scans.relative(1, 0), 0.01);
  Eigen::Matrix<double, 6, 6> information = link.information;
  information.row(3).setZero(); // along the x axis of the target
  information.col(3).setZero();
  link.information = information;
  Eigen::Matrix4d slid = Eigen::Matrix4d::Identity();
  slid(0, 3) = 0.7;
  std::vector<StoredPose> poses = {
      scans.poses[0], Eigen::Matrix4d(scans.poses[0] * slid * scans.relative(1, 0))};
  solvePoses(scans.descriptions, allOf(scans), {link}, poses);
  EXPECT_NEAR(scans.error(0, 1, poses), 0.7, 1e-3);
}

} // namespace
