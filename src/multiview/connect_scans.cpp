/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include <pcl/registration/kss/scan_work.h>

#include "multiview/candidates_of_pairs.h"
#include "multiview/consensus.h"
#include "multiview/pair_choice.h"
#include "multiview/placement_of_scans.h"
#include "multiview/pose_graph.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <string>

namespace pcl {
namespace kss {
namespace {

/** Scans that share so much of one of them, by their outlines, are asked for what they
 * say about their poses. */
constexpr double enough_overlap = 0.2;

/** Each scan fits so many others, about; and of the pairs that confidences were fitted
 * on, three fit for two that do not: the logarithm of that. */
constexpr double partners_that_fit = 4.0, usual_log_odds = 0.4;

/** So many pairs that are as sure as they say are assumed beside those that there are;
 * and less than this changes nothing. */
constexpr double few = 3.0, least_shift = 0.2;

/** Loops cope with wrong pairs as long as so much of those that are sure agrees; of
 * rooms that fit on each other less does, one upon the other though they lie. */
constexpr double least_agreeing = 0.45;

/** Each scan is to have so many pairs that agree with the model, as far as there are
 * others that it overlaps by so much of both. */
constexpr std::size_t enough_confirmations = 4;
constexpr double confirming_overlap = 0.5;

/** Of each scan, so many of these at most: more of them say the same again. */
constexpr std::size_t most_overlapping = 16;

/** The error of a pair's pose as a share of the scan's radius, where nothing better is
 * known: degrees, not tens of them. */
constexpr double usual_error = 0.02;

/** A pose that the model keeps is off by no more than this share of the radius. */
constexpr double kept_share = 0.05;

/** Surfaces of scans are off by more than chance: so much of the spacing of the points
 * by what is not rigid, or seen from elsewhere, however many points there are. */
constexpr double unmodelled = 0.1;

/** Rounds of trying more pairs, and steps of the joint refinement. */
constexpr int most_rounds = 4, most_steps = 10;

/** Poses are at rest when no scan moves by more than this share of the spacing. */
constexpr double at_rest_share = 0.05;

using Matrix6 = Eigen::Matrix<double, 6, 6>;

/** The work on a set of scans. */
class Connection {
public:
  Connection(std::size_t size,
             const MultiviewSettings& settings,
             ScanCrew& crew,
             const ProgressCallback& progress)
  : settings_(settings)
  , crew_(crew)
  , scans_(size)
  , failures_(size)
  {
    stages_.restart(progress);
  }

  Multiview
  run()
  {
    describe();
    registerPairs(
        pairsToTry(resemblances_, usable(), settings_.all_pairs, settings_.partners),
        ScanTask::Kind::TRY, "pairs");
    place();
    confirm();
    // what that has left apart is looked at again, thoroughly
    for (int round = 0; round < most_rounds; ++round) {
      const std::vector<ScanPair> wanted = wantedPairs(
          resemblances_, usable(), groups_, pairs_, thorough_, settings_.partners);
      if (wanted.empty())
        break;
      registerPairs(wanted, ScanTask::Kind::REGISTER, "pairs of groups");
      const std::size_t before = groups_.size();
      place();
      if (groups_.size() == before)
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
    std::vector<ScanTask> tasks(scans_.size());
    for (std::size_t i = 0; i < tasks.size(); ++i)
      tasks[i].source = i;
    stages_.begin("scans");
    std::vector<ScanAnswer> answers = work(tasks);
    stages_.end();
    for (std::size_t i = 0; i < scans_.size(); ++i) {
      scans_[i] = std::move(answers[i].description);
      failures_[i] = answers[i].failure;
    }
    if (usable().size() > settings_.all_pairs) {
      stages_.begin("resemblances");
      resemblances_ = resemblancesOf(scans_, usable());
      stages_.end();
    }
    else
      resemblances_.setZero(scans_.size(), scans_.size());
  }

  std::vector<std::size_t>
  usable() const
  {
    std::vector<std::size_t> numbers;
    for (std::size_t i = 0; i < scans_.size(); ++i)
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

  /** Groups, and poses in them, by what the pairs say. Where pairs that are sure by
   * themselves turn out to disagree, as those of rooms that are built alike, all are
   * believed less. */
  void
  place()
  {
    std::vector<PairResult> pairs = group_pairs_;
    std::size_t tried = 0;
    for (const auto& [scans, pair] : pairs_) {
      pairs.push_back(pair);
      tried += pair.poses.empty() ? 0 : 1;
    }
    const double base = baseShift(tried);
    double shift = base;
    for (int round = 0; round < most_rounds; ++round) {
      const std::vector<PoseCandidate> candidates = candidatesOf(pairs, shift);
      Consensus consensus = consensusOf(scans_, candidates);
      poses_ = std::move(consensus.poses);
      groups_ = std::move(consensus.groups);
      for (const PlacedGroup& group : groups_)
        solvePoses(scans_, group, linksOf(group, candidates), poses_);
      const double shown = base + shiftOfAgreement(pairs);
      if (shown > shift - least_shift)
        return;
      shift = shown;
    }
  }

  /** Confidences were fitted on pairs most of which fit. Of many scans each fits a few
   * others: the more pairs there are for each, the fewer of them are right. */
  double
  baseShift(std::size_t tried) const
  {
    const double right = partners_that_fit / 2.0 * static_cast<double>(usable().size());
    const double others = static_cast<double>(tried) - right;
    return others <= 0.0 ? 0.0
                         : std::min(0.0, std::log(right / others) - usual_log_odds);
  }

  /** By how much the odds of pairs have to change, as a logarithm, for as many of those
   * that are accepted to agree with the model as say so; 0 where most of them do. */
  double
  shiftOfAgreement(const std::vector<PairResult>& pairs) const
  {
    const std::vector<std::size_t> group_of = groupOfEach(groups_, scans_.size());
    double accepted = 0.0, expected = 0.0, agreeing = 0.0;
    for (const PairResult& pair : pairs) {
      if (pair.failure.cause != FailureCause::NONE || pair.poses.empty())
        continue;
      accepted += 1.0;
      expected += std::min(pair.confidence, 0.9);
      if (group_of[pair.source] == group_of[pair.target] && isKept(pair))
        agreeing += 1.0;
    }
    if (accepted == 0.0)
      return 0.0;
    // a few that are as expected: one or two pairs prove nothing
    const double usual = expected / accepted;
    const double share = (agreeing + few * usual) / (accepted + few);
    return share < least_agreeing ? logOdds(share) - logOdds(usual) : 0.0;
  }

  Eigen::Matrix4d
  relativePose(std::size_t source, std::size_t target) const
  {
    return inverted(poses_[target]) * Eigen::Matrix4d(poses_[source]);
  }

  /** How far a pose of a pair places the source from where the model does. */
  double
  deviationOf(std::size_t source, std::size_t target, const StoredPose& pose) const
  {
    return displacement(scans_[source], relativePose(source, target), pose);
  }

  double
  smallerRadius(std::size_t a, std::size_t b) const
  {
    return std::min(radiusOf(scans_[a]), radiusOf(scans_[b]));
  }

  /** What the pairs of a group say, those that agree with the rest. */
  std::vector<PoseLink>
  linksOf(const PlacedGroup& group, const std::vector<PoseCandidate>& candidates) const
  {
    const std::set<std::size_t> members(group.begin(), group.end());
    std::vector<PoseLink> links;
    for (const PoseCandidate& candidate : candidates) {
      const auto [source, target] = std::pair(candidate.source, candidate.target);
      if (!members.count(source) || !members.count(target))
        continue;
      const double radius = smallerRadius(source, target);
      if (deviationOf(source, target, candidate.transformation) >
          2.0 * agreeing_share * radius)
        continue;
      PoseLink link;
      link.source = source;
      link.target = target;
      link.transformation = candidate.transformation;
      link.information =
          informationOfDisplacement(scans_[source], candidate.transformation) /
          std::pow(usual_error * radius, 2);
      links.push_back(link);
    }
    return links;
  }

  /** Try more pairs of scans that hang on few others, where the model says that they
   * overlap: those agree, or speak against the model. */
  void
  confirm()
  {
    for (int round = 0; round < most_rounds; ++round) {
      std::vector<ScanPair> pairs;
      for (const PlacedGroup& group : groups_)
        for (const ScanPair& pair : unconfirmedPairs(group))
          pairs.push_back(pair);
      if (pairs.empty())
        return;
      registerPairs(pairs, ScanTask::Kind::TRY, "pairs that confirm");
      place();
    }
  }

  std::set<ScanPair>
  unconfirmedPairs(const PlacedGroup& group) const
  {
    std::map<std::size_t, std::size_t> confirmations;
    std::map<std::size_t, std::vector<std::pair<double, ScanPair>>> more;
    for (const std::size_t a : group)
      for (const std::size_t b : group) {
        if (a >= b)
          continue;
        const auto found = pairs_.find({a, b});
        if (found != pairs_.end()) {
          const std::size_t agrees = isKept(found->second) ? 1 : 0;
          confirmations[a] += agrees;
          confirmations[b] += agrees;
          continue;
        }
        const double overlap =
            expectedOverlap(scans_[a], scans_[b], relativePose(a, b)).least;
        if (overlap >= confirming_overlap) {
          more[a].push_back({-overlap, {a, b}});
          more[b].push_back({-overlap, {a, b}});
        }
      }
    std::set<ScanPair> pairs;
    for (auto& [scan, of_scan] : more) {
      std::sort(of_scan.begin(), of_scan.end());
      const std::size_t known = confirmations[scan];
      for (std::size_t p = 0; p + known < enough_confirmations && p < of_scan.size();
           ++p)
        pairs.insert(of_scan[p].second);
    }
    return pairs;
  }

  /** The pose of a pair that is nearest to where the model has it. */
  struct NearestPose {
    std::size_t pose = 0;
    double deviation = std::numeric_limits<double>::infinity();
  };

  NearestPose
  nearestPose(const PairResult& pair) const
  {
    NearestPose nearest;
    for (std::size_t i = 0; i < pair.poses.size(); ++i) {
      const double deviation =
          deviationOf(pair.source, pair.target, pair.poses[i].transformation);
      if (deviation < nearest.deviation)
        nearest = {i, deviation};
    }
    return nearest;
  }

  /** Whether a pose of a pair is where the model has it. */
  bool
  isKept(const PairResult& pair) const
  {
    return nearestPose(pair).deviation <=
           kept_share * smallerRadius(pair.source, pair.target);
  }

  /** The scans of a group where they are. */
  std::vector<PlacedScan>
  placed(const PlacedGroup& group) const
  {
    std::vector<PlacedScan> scans;
    for (const std::size_t scan : group)
      scans.push_back({scan, poses_[scan]});
    return scans;
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
               resemblances_, usable(), groups_, pairs_, settings_.partners)) {
        const PlacedGroup &source = groups_[second], &target = groups_[first];
        // of two scans, all has been said
        if (source.size() + target.size() < 3 || !tried.insert({source, target}).second)
          continue;
        tasks.push_back(connecting(source.front(), placed(source), target.front(),
                                   placed(target), false));
      }
      if (tasks.empty())
        return;
      stages_.begin("groups");
      const std::vector<ScanAnswer> answers = work(tasks);
      stages_.end();
      const std::size_t before = groups_.size();
      for (std::size_t i = 0; i < tasks.size(); ++i)
        takeGroups(tasks[i], answers[i].pair);
      place();
      if (groups_.size() == before)
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
        const double overlap =
            expectedOverlap(scans_[source.scan], scans_[target.scan], pose).most;
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

  /** Pairs of a group that lie on each other: of each scan those that do so most. */
  std::set<ScanPair>
  overlappingPairs(const PlacedGroup& group) const
  {
    using Partner = std::pair<double, ScanPair>;
    std::map<std::size_t, std::vector<Partner>> partners;
    for (const std::size_t a : group)
      for (const std::size_t b : group) {
        if (a >= b)
          continue;
        const double overlap =
            expectedOverlap(scans_[a], scans_[b], relativePose(a, b)).most;
        if (overlap < enough_overlap)
          continue;
        partners[a].push_back({-overlap, {a, b}});
        partners[b].push_back({-overlap, {a, b}});
      }
    std::set<ScanPair> pairs;
    for (auto& [scan, of_scan] : partners) {
      std::sort(of_scan.begin(), of_scan.end());
      for (std::size_t p = 0; p < std::min(most_overlapping, of_scan.size()); ++p)
        pairs.insert(of_scan[p].second);
    }
    return pairs;
  }

  /** Move all scans of a group at once to where the points of all of them that match
   * lie on each other's planes: each pair of scans that overlap makes a step of ICP,
   * and the poses are those that are in best agreement with all steps. */
  void
  refine()
  {
    stages_.begin("joint refinement");
    for (int step = 0; step < most_steps; ++step)
      if (stepOfAll(step) < at_rest_share)
        break;
    stages_.end();
  }

  /** A step of the joint refinement.
   * \return how far the scan moved that moved most, in spacings */
  double
  stepOfAll(int step)
  {
    std::vector<ScanTask> tasks;
    for (const PlacedGroup& group : groups_)
      for (const auto& [source, target] : overlappingPairs(group)) {
        ScanTask task;
        task.kind = ScanTask::Kind::STEP;
        task.source = source;
        task.target = target;
        task.pose = relativePose(source, target);
        tasks.push_back(task);
      }
    if (tasks.empty())
      return 0.0;
    const std::vector<ScanAnswer> answers =
        work(tasks, static_cast<double>(step) / most_steps,
             static_cast<double>(step + 1) / most_steps);
    const std::vector<StoredPose> before = poses_;
    for (const PlacedGroup& group : groups_)
      solvePoses(scans_, group, linksOfSteps(group, answers), poses_);
    double moved = 0.0;
    for (const std::size_t scan : usable())
      moved = std::max(moved, displacement(scans_[scan], before[scan], poses_[scan]) /
                                  scans_[scan].spacing);
    return moved;
  }

  std::vector<PoseLink>
  linksOfSteps(const PlacedGroup& group, const std::vector<ScanAnswer>& answers) const
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
      const double error = unmodelled * std::max(scans_[pair.source].spacing,
                                                 scans_[pair.target].spacing);
      const Matrix6 U_inverse =
          informationOfDisplacement(scans_[pair.source], pose.transformation) /
          (error * error);
      const Matrix6 information = pose.information;
      link.information =
          U_inverse - U_inverse * (information + U_inverse).ldlt().solve(U_inverse);
      links.push_back(link);
    }
    return links;
  }

  /** The triangles of pairs whose poses lead back to where they began. */
  std::size_t
  trianglesOf(const GraphPair& pair,
              const std::map<ScanPair, Eigen::Matrix4d>& kept) const
  {
    const std::size_t a = pair.result.source, b = pair.result.target;
    const auto poseOf = [&](std::size_t source,
                            std::size_t target) -> std::optional<Eigen::Matrix4d> {
      const auto found =
          kept.find({std::min(source, target), std::max(source, target)});
      if (found == kept.end())
        return {};
      return source < target ? found->second : inverted(found->second);
    };
    const StoredPose& own = pair.result.poses[pair.pose].transformation;
    std::size_t triangles = 0;
    for (std::size_t c = 0; c < scans_.size(); ++c) {
      if (c == a || c == b)
        continue;
      const auto to_c = poseOf(a, c), from_c = poseOf(c, b);
      if (to_c && from_c &&
          displacement(scans_[a], *from_c * *to_c, own) <=
              agreeing_share * smallerRadius(a, b))
        ++triangles;
    }
    return triangles;
  }

  /** What a pair is to the model. */
  GraphPair
  judged(const PairResult& pair, const std::vector<std::size_t>& group_of) const
  {
    GraphPair graph;
    graph.result = pair;
    const bool is_accepted = pair.failure.cause == FailureCause::NONE;
    // what says nothing of the scans; those of very different sizes are refused
    const std::set<FailureCause> troubles = {
        FailureCause::DEVICE, FailureCause::STOPPED, FailureCause::OTHER};
    graph.verdict = is_accepted                              ? PairVerdict::REJECTED
                    : troubles.count(pair.failure.cause) > 0 ? PairVerdict::FAILED
                                                             : PairVerdict::REFUSED;
    graph.reason = pair.failure.reason;
    if (pair.poses.empty())
      return graph;
    if (group_of[pair.source] != group_of[pair.target]) {
      if (is_accepted)
        graph.reason = "No other pair confirms it, and by itself it is not sure enough "
                       "among so many pairs.";
      return graph;
    }
    if (isKept(pair)) {
      const auto [pose, deviation] = nearestPose(pair);
      graph.pose = pose;
      graph.deviation = deviation;
      graph.verdict = PairVerdict::KEPT;
      graph.reason.clear();
      return graph;
    }
    graph.deviation =
        deviationOf(pair.source, pair.target, pair.poses.front().transformation);
    if (is_accepted) {
      std::ostringstream reason;
      reason << "Other pairs place the source " << graph.deviation
             << " from there, root mean square.";
      graph.reason = reason.str();
    }
    return graph;
  }

  Multiview
  result()
  {
    Multiview model;
    std::stable_sort(
        groups_.begin(), groups_.end(), [](const PlacedGroup& a, const PlacedGroup& b) {
          return a.size() != b.size() ? a.size() > b.size() : a.front() < b.front();
        });
    const std::vector<std::size_t> group_of = groupOfEach(groups_, scans_.size());
    model.scans.resize(scans_.size());
    for (std::size_t g = 0; g < groups_.size(); ++g) {
      const Eigen::Matrix4d to_first = inverted(poses_[groups_[g].front()]);
      for (const std::size_t scan : groups_[g]) {
        model.scans[scan] = {to_first * Eigen::Matrix4d(poses_[scan]), g,
                             scans_[scan].centroid, failures_[scan]};
      }
    }
    model.groups = groups_;
    std::map<ScanPair, Eigen::Matrix4d> kept;
    for (const PairResult& pair : group_pairs_)
      if (judged(pair, group_of).verdict == PairVerdict::KEPT)
        pairs_[{pair.source, pair.target}] = pair;
    for (const auto& [scans, pair] : pairs_) {
      model.pairs.push_back(judged(pair, group_of));
      const GraphPair& graph = model.pairs.back();
      if (graph.verdict == PairVerdict::KEPT)
        kept[scans] = pair.poses[graph.pose].transformation;
    }
    for (GraphPair& pair : model.pairs)
      if (!pair.result.poses.empty())
        pair.loops = trianglesOf(pair, kept);
    return model;
  }

  const MultiviewSettings& settings_;
  ScanCrew& crew_;
  Stages stages_;
  std::vector<ScanDescription> scans_;
  std::vector<Failure> failures_;
  Eigen::MatrixXf resemblances_; ///< where there are too many scans for all pairs
  std::map<ScanPair, PairResult> pairs_; ///< that have been tried
  std::vector<PairResult> group_pairs_; ///< what groups have said of two of their scans
  std::set<ScanPair> thorough_;         ///< those that were not tried quickly
  std::vector<PlacedGroup> groups_;
  std::vector<StoredPose> poses_;
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
