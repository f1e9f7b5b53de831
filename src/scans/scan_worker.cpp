/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include <pcl/registration/kss/detail/usable_points.h>
#include <pcl/registration/kss/scan_work.h>

#include "prepared_scan.h"
#include "scans/description.h"
#include "scans/scan_store.h"
#include "support/parallel.h"

#include <Eigen/LU>

#include <algorithm>
#include <mutex>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace pcl {
namespace kss {
namespace {

/** The inverse of a covariance; zero where there is none. */
Eigen::Matrix<double, 6, 6>
informationOf(const SurfacePrecision& precision)
{
  if (precision.unknowns < 6)
    return Eigen::Matrix<double, 6, 6>::Zero();
  const Eigen::Matrix<double, 6, 6> covariance =
      precision.covariance.topLeftCorner<6, 6>();
  return covariance.ldlt().solve(Eigen::Matrix<double, 6, 6>::Identity());
}

PairPose
poseOf(const Alternative& alternative)
{
  PairPose pose;
  pose.transformation = alternative.transformation;
  pose.overlap = alternative.overlap;
  pose.log_odds = logOddsOf(alternative);
  return pose;
}

/** What a registration has come to, as far as graphs go by it. */
void
take(const Registered& registered, PairResult& pair)
{
  for (const Alternative& alternative : registered.alternatives)
    pair.poses.push_back(poseOf(alternative));
  if (!pair.poses.empty())
    pair.poses.front().information = informationOf(registered.precision);
  pair.confidence = confidenceOf(registered.alternatives);
  pair.ambiguous = isAmbiguous(registered.alternatives);
  pair.failure = registered.failure;
}

/** Where a step leads. */
void
takeStep(const Registered& stepped, PairResult& pair)
{
  pair.failure = stepped.failure;
  PairPose pose;
  pose.transformation = stepped.transformation;
  pose.information = informationOf(stepped.precision);
  if (stepped.failure.cause == FailureCause::NONE)
    pair.poses = {pose};
}

/** So many points of a group are registered: no fewer than what judges poses. */
constexpr std::size_t most_points_of_group = 400000;

/** How the scans are registered: pairs side by side, each in one thread. */
Settings
settingsOfPairs(Settings settings)
{
  settings.threads = 1;
  settings.progress = {};
  return settings;
}

} // namespace

ScanCrew::~ScanCrew() = default;

struct ScanWorker::Implementation {
  Implementation(const Settings& asked, ScanLoader loader, std::size_t room)
  : settings(settingsOfPairs(asked))
  , load(std::move(loader))
  , store([this](std::size_t number) { return made(number); }, room)
  {
  }

  /** Have a registration that nobody else uses meanwhile do something. */
  template <typename Work>
  auto
  borrowing(const Work& work)
  {
    std::unique_ptr<CloudRegistration> own;
    {
      const std::lock_guard<std::mutex> lock(mutex);
      if (!idle.empty()) {
        own = std::move(idle.back());
        idle.pop_back();
      }
    }
    if (!own)
      own = std::make_unique<CloudRegistration>(settings);
    auto result = work(*own);
    const std::lock_guard<std::mutex> lock(mutex);
    idle.push_back(std::move(own));
    return result;
  }

  ScanStore::Scan
  made(std::size_t number)
  {
    const std::shared_ptr<const Cloud> cloud = load(number);
    return borrowing(
        [&](CloudRegistration& registration) { return registration.prepared(*cloud); });
  }

  /** The points of a group in its frame. */
  Cloud
  merged(const std::vector<PlacedScan>& group)
  {
    std::vector<Eigen::Vector3d> points;
    for (const PlacedScan& placed : group) {
      const ScanStore::Scan scan = store.get(placed.scan);
      std::vector<Eigen::Index> all(scan->local.points.cols());
      std::iota(all.begin(), all.end(), 0);
      for (const Eigen::Index i :
           spread(all, std::max<std::size_t>(1, most_points_of_group / group.size()))) {
        const Eigen::Vector3d at =
            scan->local.points.col(i).cast<double>() + scan->local.origin;
        points.emplace_back((placed.pose * at.homogeneous()).head<3>());
      }
    }
    Cloud cloud;
    cloud.points.resize(3, points.size());
    for (std::size_t i = 0; i < points.size(); ++i)
      cloud.points.col(i) = points[i];
    return cloud;
  }

  void
  connect(const ScanTask& task, ScanAnswer& answer)
  {
    Settings of_groups = settings;
    of_groups.estimate_scale = task.estimates_scale;
    CloudRegistration registration(of_groups);
    const auto source = registration.prepared(merged(task.source_group));
    const auto target = registration.prepared(merged(task.target_group));
    take(registration.align(*source, *target), answer.pair);
    answer.pair.of_groups = true;
  }

  void
  answer(const ScanTask& task, ScanAnswer& answer)
  {
    if (task.kind == ScanTask::Kind::CONNECT) {
      connect(task, answer);
      return;
    }
    const ScanStore::Scan source = store.get(task.source);
    if (task.kind == ScanTask::Kind::DESCRIBE) {
      answer.description = descriptionOf(*source);
      return;
    }
    const ScanStore::Scan target = store.get(task.target);
    borrowing([&](CloudRegistration& registration) {
      if (task.kind == ScanTask::Kind::REGISTER)
        take(registration.align(*source, *target), answer.pair);
      else if (task.kind == ScanTask::Kind::TRY)
        take(registration.align(*source, *target, Thoroughness::QUICK), answer.pair);
      else
        takeStep(registration.step(*source, *target, task.pose), answer.pair);
      return true;
    });
  }

  Settings settings;
  ScanLoader load;
  ScanStore store;
  std::mutex mutex;
  std::vector<std::unique_ptr<CloudRegistration>> idle;
};

ScanWorker::ScanWorker(const Settings& settings, ScanLoader load, std::size_t room)
: implementation_(std::make_unique<Implementation>(settings, std::move(load), room))
{
}

ScanWorker::~ScanWorker() = default;

ScanAnswer
ScanWorker::answer(const ScanTask& task)
{
  ScanAnswer answer;
  answer.pair.source = task.source;
  answer.pair.target = task.target;
  try {
    implementation_->answer(task, answer);
  }
  catch (...) {
    answer.failure = failureOfException();
  }
  return answer;
}

ThreadCrew::ThreadCrew(ScanWorker& worker, unsigned int threads)
: worker_(worker)
, threads_(threads)
{
}

void
ThreadCrew::work(const std::vector<ScanTask>& tasks,
                 const std::function<void(std::size_t, ScanAnswer)>& done)
{
  std::mutex mutex;
  inParallel(static_cast<std::ptrdiff_t>(tasks.size()), threads_, 1,
             [&](std::ptrdiff_t i) {
               ScanAnswer answer = worker_.answer(tasks[i]);
               const std::lock_guard<std::mutex> lock(mutex);
               done(i, std::move(answer));
             });
}

} // namespace kss
} // namespace pcl
