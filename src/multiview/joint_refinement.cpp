/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "multiview/joint_refinement.h"

#include "multiview/pair_choice.h"
#include "multiview/partners.h"
#include "multiview/pose_graph.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <set>

namespace pcl {
namespace kss {
namespace {

/** Scans that share so much of one of them, by their outlines, are asked for what they
 * say about their poses. */
constexpr double enough_overlap = 0.2;

/** Of each scan, so many of those at most: more of them say the same again. */
constexpr std::size_t most_overlapping = 16;

/** Surfaces of scans are off by more than chance: so much of the spacing of the points
 * by what is not rigid, or seen from elsewhere, however many points there are. */
constexpr double unmodelled = 0.1;

/** So many steps at most. */
constexpr int most_steps = 10;

/** Poses are at rest when no scan moves by more than this share of the spacing. */
constexpr double at_rest_share = 0.05;

using Matrix6 = Eigen::Matrix<double, 6, 6>;

/** Pairs of a group that lie on each other: of each scan those that do so most. */
std::set<ScanPair>
overlappingPairs(const PlacedGroup& group, const PlacedScans& placed)
{
  Partners partners;
  for (const std::size_t a : group)
    for (const std::size_t b : group) {
      if (a >= b)
        continue;
      const double overlap = placed.overlapOf(a, b).most;
      if (overlap >= enough_overlap)
        partners.add(-overlap, {a, b});
    }
  return partners.best([](std::size_t) { return most_overlapping; });
}

std::vector<PoseLink>
linksOfSteps(const PlacedGroup& group,
             const std::vector<ScanAnswer>& answers,
             const std::vector<ScanDescription>& scans)
{
  const std::set<std::size_t> members(group.begin(), group.end());
  std::vector<PoseLink> links;
  for (const ScanAnswer& answer : answers) {
    const PairResult& pair = answer.pair;
    if (!members.count(pair.source) || pair.poses.empty())
      continue;
    const PairPose& pose = pair.poses.front();
    PoseLink link;
    link.source = pair.source;
    link.target = pair.target;
    link.transformation = pose.transformation;
    // (S + U)^-1, S being the covariance and U what is not modelled
    const double error =
        unmodelled * std::max(scans[pair.source].spacing, scans[pair.target].spacing);
    const Matrix6 U_inverse =
        informationOfDisplacement(scans[pair.source], pose.transformation) /
        (error * error);
    const Matrix6 information = pose.information;
    link.information =
        U_inverse - U_inverse * (information + U_inverse).ldlt().solve(U_inverse);
    links.push_back(link);
  }
  return links;
}

/** How far the scan moved that moved most, in spacings. */
double
largestMove(const PlacedScans& placed, const std::vector<StoredPose>& before)
{
  double moved = 0.0;
  for (const PlacedGroup& group : placed.groups)
    for (const std::size_t scan : group) {
      const ScanDescription& description = placed.descriptions[scan];
      if (group.size() > 1)
        moved = std::max(moved,
                         displacement(description, before[scan], placed.poses[scan]) /
                             description.spacing);
    }
  return moved;
}

} // namespace

void
refineJointly(PlacedScans& placed,
              const std::function<std::vector<ScanAnswer>(
                  const std::vector<ScanTask>&, double from, double to)>& work)
{
  for (int step = 0; step < most_steps; ++step) {
    std::vector<ScanTask> tasks;
    for (const PlacedGroup& group : placed.groups)
      for (const auto& [source, target] : overlappingPairs(group, placed)) {
        ScanTask task;
        task.kind = ScanTask::Kind::STEP;
        task.source = source;
        task.target = target;
        task.pose = placed.relativePose(source, target);
        tasks.push_back(task);
      }
    if (tasks.empty())
      return;
    const std::vector<ScanAnswer> answers =
        work(tasks, static_cast<double>(step) / most_steps,
             static_cast<double>(step + 1) / most_steps);
    const std::vector<StoredPose> before = placed.poses;
    for (const PlacedGroup& group : placed.groups)
      solvePoses(placed.descriptions, group,
                 linksOfSteps(group, answers, placed.descriptions), placed.poses);
    if (largestMove(placed, before) < at_rest_share)
      return;
  }
}

} // namespace kss
} // namespace pcl
