/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "io/fields.h"
#include "multiview/model.h"

#include <Eigen/Geometry>

#include <cmath>
#include <random>

namespace kss_test {

/** \brief A rigid motion. */
inline Eigen::Matrix4d
motion(double angle, const Eigen::Vector3d& axis, const Eigen::Vector3d& shift)
{
  Eigen::Affine3d pose(Eigen::AngleAxisd(angle, axis.normalized()));
  pose.translation() = shift;
  return pose.matrix();
}

/** \brief A part of a bumpy body, round a direction in the plane of x and y.
 * \param[in] place of the body's frame in the scan's
 */
inline tool::Geometry
scanOfBody(double direction, std::size_t points, const Eigen::Matrix4d& place)
{
  std::mt19937_64 generator(static_cast<std::uint64_t>(1000.0 * direction) + 7);
  const auto random = [&] { return static_cast<double>(generator() >> 11) * 0x1p-53; };
  std::vector<double> numbers;
  while (numbers.size() < 3 * points) {
    const double turn = direction + (random() - 0.5) * 2.2;
    const double height = 2.0 * random() - 1.0, flat = std::sqrt(1.0 - height * height);
    const double radius =
        1.0 + 0.07 * std::sin(5.0 * turn) * flat + 0.06 * std::cos(9.0 * height);
    const Eigen::Vector3d point =
        radius * Eigen::Vector3d(2.4 * flat * std::cos(turn),
                                 1.5 * flat * std::sin(turn), 0.9 * height);
    const Eigen::Vector3d placed = Eigen::Affine3d(place) * point;
    numbers.insert(numbers.end(), placed.begin(), placed.end());
  }
  tool::Geometry geometry;
  geometry.cloud = tool::cloudOfDoubles(numbers, {"x", "y", "z"});
  return geometry;
}

/** \brief The direction that a scan of handMadeModel() looks from, and the place of the
 * body in it. */
inline std::pair<double, Eigen::Matrix4d>
viewOfScan(std::size_t scan)
{
  const double direction = 0.9 * static_cast<double>(scan);
  return {direction,
          motion(0.4 * scan, {0.2, 0.1, 1.0}, {0.3 * scan, 0.1 * scan, -0.2 * scan})};
}

/** \brief Twelve scans: a group of seven, one of three, one alone, and one that could
 * not be used; pairs of all verdicts. */
inline tool::Model
handMadeModel(std::size_t points)
{
  using namespace pcl::kss;
  tool::Model model;
  model.maker = "pcl_kss_icp_multiview 0.2.0";
  model.settings = {{"mode", "overlap"}, {"estimate_scale", "false"}};
  model.seconds = 42.5;
  model.tasks = {{"scans", 12}, {"quick pairs", 30}};
  model.result.seconds = {{"descriptions", 1.25}, {"pairs", 40.0}, {"refinement", 1.0}};
  model.result.groups = {{0, 1, 2, 3, 4, 5, 6}, {7, 8, 9}, {10}, {11}};
  model.result.scans.resize(12);
  model.read = [points](std::size_t scan) {
    const auto [direction, place] = viewOfScan(scan);
    return scanOfBody(direction, points, place);
  };
  const auto poseInWorld = [](std::size_t scan) -> Eigen::Matrix4d {
    return viewOfScan(scan).second.inverse();
  };
  for (std::size_t g = 0; g < model.result.groups.size(); ++g)
    for (const std::size_t scan : model.result.groups[g]) {
      const std::size_t first = model.result.groups[g].front();
      model.result.scans[scan].group = g;
      if (scan != first)
        model.result.scans[scan].transformation =
            poseInWorld(first).inverse() * poseInWorld(scan);
    }
  model.result.scans[11].failure = {FailureCause::INPUT, "has 3 points on a line"};
  for (std::size_t i = 0; i < 12; ++i) {
    model.files.push_back("scans/body_" + std::to_string(i + 1) + ".ply");
    const tool::Points positions =
        tool::positionsOf(scanOfBody(viewOfScan(i).first, 500, viewOfScan(i).second));
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const auto& position : positions)
      sum += position;
    model.result.scans[i].centroid = sum / static_cast<double>(positions.size());
  }
  for (std::size_t i = 0; i < 12; ++i)
    for (std::size_t j = 0; j < i; ++j) {
      GraphPair pair;
      pair.result.source = i;
      pair.result.target = j;
      const bool is_one_group =
          model.result.scans[i].group == model.result.scans[j].group;
      const std::size_t apart = i - j;
      if (i == 11) {
        pair.verdict = PairVerdict::FAILED;
        pair.reason = "the source has 3 points on a line";
        model.result.pairs.push_back(pair);
        continue;
      }
      PairPose pose;
      pose.transformation = poseInWorld(j).inverse() * poseInWorld(i);
      const Eigen::Matrix<double, 6, 6> root =
          Eigen::Matrix<double, 6, 6>::Identity() * 40.0 +
          Eigen::Matrix<double, 6, 6>::Constant(3.0);
      pose.information = root * root.transpose();
      pose.overlap = {0.75 / apart, 0.7 / apart, 1.2 / apart};
      pose.log_odds = 4.0 / apart;
      pair.result.poses = {pose, pose};
      if (is_one_group && apart <= 2) {
        pair.verdict = PairVerdict::KEPT;
        pair.result.confidence = 0.97 - 0.23 * (apart - 1) - 0.01 * i;
        pair.deviation = 0.0021 * i;
        pair.loops = 3 - apart;
      }
      else if (apart == 3) {
        pair.verdict = PairVerdict::REJECTED;
        pair.result.confidence = 0.31 + 0.03 * i;
        pair.result.ambiguous = i % 2 == 1;
        pair.deviation = is_one_group ? 0.84 : 0.0;
        pair.reason = "two loops of other pairs place the source elsewhere";
      }
      else {
        pair.result.confidence = 0.3 / (apart * apart);
        pair.result.failure = {FailureCause::NO_FIT, "the clouds do not fit"};
        pair.reason = "12 % of the source is explained by the target's surfaces, which "
                      "chance may account for";
      }
      model.result.pairs.push_back(pair);
    }
  return model;
}

} // namespace kss_test
