/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include <pcl/registration/kss/scan_work.h>

#include "multiview/joint_refinement.h"
#include "multiview/pair_choice.h"
#include "multiview/placed_scans.h"
#include "multiview/placing.h"
#include "multiview/verdicts.h"

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>

namespace pcl {
namespace kss {
namespace {

/** Rounds of trying more pairs. */
constexpr int most_rounds = 4;

/** The work on a set of scans. */
class Connection {
public:
  Connection(std::size_t size,
             const MultiviewSettings& settings,
             ScanCrew& crew,
             const ProgressCallback& progress)
  : settings_(settings)
  , crew_(crew)
  , failures_(size)
  {
    stages_.restart(progress);
  }

  Multiview
  run()
  {
    describe();
    const std::vector<ScanPair> resembling =
        pairsToTry(resemblances_, usable(), settings_.all_pairs, settings_.partners);
    resembling_.insert(resembling.begin(), resembling.end());
    registerPairs(resembling, ScanTask::Kind::TRY, "pairs");
    place();
    confirm();
    // what that has left apart is looked at again, thoroughly
    for (int round = 0; round < most_rounds; ++round) {
      const std::vector<ScanPair> wanted =
          wantedPairs(resemblances_, usable(), placed_.groups, pairs_, thorough_,
                      settings_.partners);
      if (wanted.empty())
        break;
      registerPairs(wanted, ScanTask::Kind::REGISTER, "pairs of groups");
      const std::size_t before = placed_.groups.size();
      place();
      if (placed_.groups.size() == before)
        break; // the rest promises less
    }
    connectGroups();
    if (settings_.refine)
      refine();
    Multiview model = result();
    if (settings_.scale_between_groups)
      model.links = linksOfGroups(model);
    model.seconds = stages_.seconds();
    return model;
  }

private:
  /** Do tasks, and tell how many are done.
   * \param[in] from the share of the stage that has been done before
   * \param[in] to the share that will be done then */
  std::vector<ScanAnswer>
  work(const std::vector<ScanTask>& tasks, double from = 0.0, double to = 1.0)
  {
    std::vector<ScanAnswer> answers(tasks.size());
    std::size_t ended = 0;
    crew_.work(tasks, [&](std::size_t number, ScanAnswer answer) {
      answers[number] = std::move(answer);
      stages_.progress(from + (to - from) * static_cast<double>(++ended) /
                                  static_cast<double>(tasks.size()));
    });
    return answers;
  }

  void
  describe()
  {
    std::vector<ScanTask> tasks(failures_.size());
    for (std::size_t i = 0; i < tasks.size(); ++i)
      tasks[i].source = i;
    stages_.begin("scans");
    std::vector<ScanAnswer> answers = work(tasks);
    stages_.end();
    for (std::size_t i = 0; i < answers.size(); ++i) {
      placed_.descriptions.push_back(std::move(answers[i].description));
      failures_[i] = answers[i].failure;
    }
    if (usable().size() > settings_.all_pairs) {
      stages_.begin("resemblances");
      resemblances_ = resemblancesOf(placed_.descriptions, usable(), settings_.threads);
      stages_.end();
    }
    else
      resemblances_.setZero(failures_.size(), failures_.size());
  }

  std::vector<std::size_t>
  usable() const
  {
    std::vector<std::size_t> numbers;
    for (std::size_t i = 0; i < failures_.size(); ++i)
      if (failures_[i].cause == FailureCause::NONE)
        numbers.push_back(i);
    return numbers;
  }

  /** \param[in] kind TRY or REGISTER, which replaces what has been tried before */
  void
  registerPairs(const std::vector<ScanPair>& pairs,
                ScanTask::Kind kind,
                const std::string& stage)
  {
    std::vector<ScanTask> tasks;
    for (const auto& [source, target] : pairs) {
      ScanTask task;
      task.kind = kind;
      task.source = source;
      task.target = target;
      tasks.push_back(task);
      if (kind == ScanTask::Kind::REGISTER)
        thorough_.insert({source, target});
    }
    stages_.begin(stage);
    for (ScanAnswer& answer : work(tasks)) {
      if (answer.failure.cause != FailureCause::NONE)
        answer.pair.failure = answer.failure;
      pairs_[{answer.pair.source, answer.pair.target}] = std::move(answer.pair);
    }
    stages_.end();
  }

  void
  place()
  {
    std::size_t with_pose = 0, resembling_with_pose = 0;
    for (const auto& [scans, pair] : pairs_) {
      with_pose += pair.poses.empty() ? 0 : 1;
      resembling_with_pose += pair.poses.empty() ? 0 : resembling_.count(scans);
    }
    // of those that resemble each other, more are right than of the rest
    const std::size_t size = usable().size();
    const double of_resembling = shiftOfMany(resembling_with_pose, size);
    const double of_others = shiftOfMany(with_pose, size);
    std::vector<PairResult> pairs = group_pairs_;
    std::vector<double> shifts(pairs.size(), of_others);
    for (const auto& [scans, pair] : pairs_) {
      pairs.push_back(pair);
      shifts.push_back(resembling_.count(scans) > 0 ? of_resembling : of_others);
    }
    placeByPairs(pairs, shifts, placed_);
  }

  /** Try pairs that would say something about where scans have been placed. */
  void
  confirm()
  {
    for (int round = 0; round < most_rounds; ++round) {
      const std::set<ScanPair> pairs = pairsThatConfirm(placed_, pairs_);
      if (pairs.empty())
        return;
      registerPairs({pairs.begin(), pairs.end()}, ScanTask::Kind::TRY,
                    "pairs that confirm");
      place();
    }
  }

  /** Two groups as wholes.
   * \param[in] source what the answer calls the source
   * \param[in] target what the answer calls the target */
  static ScanTask
  connecting(std::size_t source,
             std::vector<PlacedScan> source_group,
             std::size_t target,
             std::vector<PlacedScan> target_group,
             bool estimates_scale)
  {
    ScanTask task;
    task.kind = ScanTask::Kind::CONNECT;
    task.source = source;
    task.target = target;
    task.source_group = std::move(source_group);
    task.target_group = std::move(target_group);
    task.estimates_scale = estimates_scale;
    return task;
  }

  /** All scans of a group show more than one of them: register groups with those that
   * resemble them most, as wholes. */
  void
  connectGroups()
  {
    std::set<std::pair<PlacedGroup, PlacedGroup>> tried;
    for (int round = 0; round < most_rounds; ++round) {
      std::vector<ScanTask> tasks;
      for (const auto& [first, second] : resemblingGroups(
               resemblances_, usable(), placed_.groups, pairs_, settings_.partners)) {
        const PlacedGroup& source = placed_.groups[second];
        const PlacedGroup& target = placed_.groups[first];
        // of two scans, all has been said
        if (source.size() + target.size() < 3 || !tried.insert({source, target}).second)
          continue;
        tasks.push_back(connecting(source.front(), placed_.members(source),
                                   target.front(), placed_.members(target), false));
      }
      if (tasks.empty())
        return;
      stages_.begin("groups");
      const std::vector<ScanAnswer> answers = work(tasks);
      stages_.end();
      const std::size_t before = placed_.groups.size();
      for (std::size_t i = 0; i < tasks.size(); ++i)
        takeGroups(tasks[i], answers[i].pair);
      place();
      if (placed_.groups.size() == before)
        return;
    }
  }

  /** Take what has come of two groups as what it says of two of their scans. */
  void
  takeGroups(const ScanTask& task, PairResult pair)
  {
    if (pair.failure.cause != FailureCause::NONE || pair.poses.empty())
      return;
    const Eigen::Matrix4d T_target_source = pair.poses.front().transformation;
    double most = -1.0;
    StoredPose best = StoredPose::Identity();
    for (const PlacedScan& source : task.source_group)
      for (const PlacedScan& target : task.target_group) {
        const Eigen::Matrix4d pose =
            inverted(target.pose) * T_target_source * Eigen::Matrix4d(source.pose);
        const double overlap = expectedOverlap(placed_.descriptions[source.scan],
                                               placed_.descriptions[target.scan], pose)
                                   .most;
        if (overlap <= most)
          continue;
        most = overlap;
        best = pose;
        pair.source = source.scan;
        pair.target = target.scan;
      }
    pair.poses.resize(1);
    pair.poses.front().transformation = best;
    pair.poses.front().information.setZero(); // is that of another centroid
    group_pairs_.push_back(pair);
  }

  /** Groups that fit each other at whatever scale. */
  std::vector<GroupLink>
  linksOfGroups(const Multiview& model)
  {
    std::vector<std::size_t> asked; // the largest ones
    for (std::size_t g = 0; g < model.groups.size(); ++g)
      if (asked.size() <= settings_.partners &&
          failures_[model.groups[g].front()].cause == FailureCause::NONE)
        asked.push_back(g);
    const auto placedIn = [&](std::size_t group) {
      std::vector<PlacedScan> scans;
      for (const std::size_t scan : model.groups[group])
        scans.push_back({scan, model.scans[scan].transformation});
      return scans;
    };
    std::vector<ScanTask> tasks;
    for (const std::size_t target : asked)
      for (const std::size_t source : asked)
        if (source > target)
          tasks.push_back(
              connecting(source, placedIn(source), target, placedIn(target), true));
    stages_.begin("scales of groups");
    std::vector<GroupLink> links;
    for (const ScanAnswer& answer : work(tasks)) {
      const PairResult& pair = answer.pair;
      if (pair.failure.cause == FailureCause::NONE && !pair.poses.empty())
        links.push_back({pair.source, pair.target, pair.poses.front().transformation,
                         pair.confidence, pair.ambiguous});
    }
    stages_.end();
    return links;
  }

  void
  refine()
  {
    stages_.begin("joint refinement");
    refineJointly(placed_, [this](const std::vector<ScanTask>& tasks, double from,
                                  double to) { return work(tasks, from, to); });
    stages_.end();
  }

  Multiview
  result()
  {
    std::vector<PlacedGroup>& groups = placed_.groups;
    std::stable_sort(
        groups.begin(), groups.end(), [](const PlacedGroup& a, const PlacedGroup& b) {
          return a.size() != b.size() ? a.size() > b.size() : a.front() < b.front();
        });
    Multiview model;
    model.groups = groups;
    model.scans.resize(failures_.size());
    for (std::size_t g = 0; g < groups.size(); ++g)
      for (const std::size_t scan : groups[g])
        model.scans[scan] = {placed_.relativePose(scan, groups[g].front()), g,
                             placed_.descriptions[scan].centroid, failures_[scan]};
    // what groups have said is told of two scans, where the model goes by it
    const std::vector<GraphPair> of_groups = verdictsOn(group_pairs_, placed_);
    std::map<ScanPair, PairResult> pairs = pairs_;
    for (const GraphPair& pair : of_groups)
      if (pair.verdict == PairVerdict::KEPT)
        pairs[{pair.result.source, pair.result.target}] = pair.result;
    std::vector<PairResult> results;
    for (const auto& [scans, pair] : pairs)
      results.push_back(pair);
    model.pairs = verdictsOn(results, placed_);
    return model;
  }

  const MultiviewSettings& settings_;
  ScanCrew& crew_;
  Stages stages_;
  std::vector<Failure> failures_; ///< why scans cannot be used
  PlacedScans placed_;
  Eigen::MatrixXf resemblances_; ///< where there are too many scans for all pairs
  std::map<ScanPair, PairResult> pairs_; ///< that have been tried
  std::set<ScanPair> resembling_;        ///< those that were tried to begin with
  std::vector<PairResult> group_pairs_; ///< what groups have said of two of their scans
  std::set<ScanPair> thorough_;         ///< those that were not tried quickly
};

} // namespace

Multiview
connectScans(std::size_t scans,
             const MultiviewSettings& settings,
             ScanCrew& crew,
             const ProgressCallback& progress)
try {
  return Connection(scans, settings, crew, progress).run();
}
catch (...) {
  Multiview model;
  model.failure = failureOfException();
  return model;
}

} // namespace kss
} // namespace pcl
