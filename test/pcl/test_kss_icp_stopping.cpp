/*
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * KSSICP that is told to stop, that a callback throws at, or that gets no threads: it
 * ends soon, says why, keeps the best pose so far, and is as good as new.
 */

#include "faults/thread_faults.h"
#include "pairs.h"
#include "search/candidate_search.h"

#include <pcl/registration/kss/detail/stopping.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <thread>

namespace {

using namespace kss_test;
using pcl::kss::FailureCause;
using KSSICP = pcl::KSSICP<pcl::PointXYZ, pcl::PointXYZ>;
using Cloud = pcl::PointCloud<pcl::PointXYZ>;
using Clock = std::chrono::steady_clock;

class Stopping : public ::testing::Test {
protected:
  Stopping()
  : pair_(pairOf(randomRigid(1)))
  {
    set(registration_, &pcl::kss::Settings::sample_points, 200);
    registration_.setScaleEstimation(false);
    setClouds(registration_, pair_);
  }

  /** Calls \a what at the \a nth call of the progress callback. */
  void
  fromProgress(int nth, const std::function<void()>& what)
  {
    calls_ = 0;
    registration_.setProgressCallback(
        [this, nth, what](const std::string& stage, double) {
          if (calls_++ != nth)
            return;
          stage_ = stage;
          what();
        });
  }

  void
  expectConsistent()
  {
    EXPECT_TRUE(pcl::kss::isSimilarity(poseFrom(registration_)));
    expectTransformed(output_, *pair_.source, registration_.getFinalTransformation());
    EXPECT_EQ(registration_.hasConverged(),
              registration_.getFailureCause() == FailureCause::NONE);
    EXPECT_EQ(registration_.hasConverged(), registration_.getFailureReason().empty());
  }

  /** Nothing of what happened is left. */
  void
  expectAsGoodAsNew()
  {
    registration_.setProgressCallback({});
    registration_.setTimeLimit(0.0);
    registration_.align(output_);
    EXPECT_TRUE(registration_.hasConverged()) << registration_.getFailureReason();
    KSSICP fresh;
    set(fresh, &pcl::kss::Settings::sample_points, 200);
    fresh.setScaleEstimation(false);
    setClouds(fresh, pair_);
    Cloud output;
    fresh.align(output);
    EXPECT_EQ(fresh.getFinalTransformation(), registration_.getFinalTransformation());
  }

  Pair<> pair_;
  KSSICP registration_;
  Cloud output_;
  int calls_ = 0;
  std::string stage_;
};

TEST_F(Stopping, AtAnyTimeKeepsTheBestPoseSoFar)
{
  fromProgress(0, [] {});
  registration_.align(output_);
  ASSERT_TRUE(registration_.hasConverged());
  const int all = calls_;
  ASSERT_GT(all, 8);
  int with_pose = 0;
  for (int nth = 0; nth < all; ++nth) {
    fromProgress(nth, [this] { registration_.cancel(); });
    ASSERT_NO_THROW(registration_.align(output_));
    expectConsistent();
    if (registration_.hasConverged()) {
      EXPECT_EQ(all - 1, nth); // all was done
      continue;
    }
    EXPECT_EQ(FailureCause::STOPPED, registration_.getFailureCause());
    const bool has_pose = !registration_.getAlternatives().empty();
    with_pose += has_pose;
    EXPECT_EQ(has_pose
                  ? "The registration was cancelled; the pose is the best one so far."
                  : "The registration was cancelled before any pose was found.",
              registration_.getFailureReason());
    if (stage_ == "final ICP")
      expectRight(registration_, pair_, 0.02);
  }
  EXPECT_GT(with_pose, 3);
  expectAsGoodAsNew();
}

TEST_F(Stopping, AtTheTimeLimit)
{
  for (const double limit : {1e-6, 1e-3, 1e-2, 2e-2, 5e-2}) {
    registration_.setTimeLimit(limit);
    EXPECT_EQ(limit, registration_.getTimeLimit());
    ASSERT_NO_THROW(registration_.align(output_));
    expectConsistent();
    if (limit < 1e-3) {
      EXPECT_EQ(FailureCause::STOPPED, registration_.getFailureCause());
      EXPECT_EQ("The time limit of 1e-06 s has passed before any pose was found.",
                registration_.getFailureReason());
    }
  }
  registration_.setTimeLimit(3600.0);
  registration_.align(output_);
  EXPECT_TRUE(registration_.hasConverged());
  expectAsGoodAsNew();
}

TEST_F(Stopping, RefusesAWrongTimeLimit)
{
  registration_.setTimeLimit(7.0);
  for (const double wrong : {-1.0, std::nan("")}) {
    registration_.setTimeLimit(wrong);
    EXPECT_EQ(7.0, registration_.getTimeLimit());
  }
}

TEST_F(Stopping, ByPCLsOwnAlignToo)
{
  registration_.setTimeLimit(1e-6);
  pcl::Registration<pcl::PointXYZ, pcl::PointXYZ>& base = registration_;
  base.align(output_);
  EXPECT_FALSE(base.hasConverged());
  EXPECT_EQ(FailureCause::STOPPED, registration_.getFailureCause());
  expectAsGoodAsNew();
}

TEST_F(Stopping, LeavesTheGuessWhereNothingBetterIsFound)
{
  const Eigen::Matrix4f guess = randomRigid(5).cast<float>();
  registration_.setTimeLimit(1e-6);
  registration_.align(output_, guess);
  EXPECT_EQ(guess, registration_.getFinalTransformation());
  expectConsistent();
}

TEST_F(Stopping, InPlace)
{
  const auto cloud = pcl::make_shared<Cloud>(*pair_.source);
  registration_.setInputSource(cloud);
  fromProgress(2, [this] { registration_.cancel(); });
  registration_.align(*cloud);
  expectTransformed(*cloud, *pair_.source, registration_.getFinalTransformation());
  EXPECT_EQ(cloud, registration_.getInputSource());
}

TEST_F(Stopping, SoonAfterACancelFromAnotherThread)
{
  // the paper's settings evaluate millions of candidates; large clouds take long before
  const Pair<> large{cloudOf<pcl::PointXYZ>(transformed(sampled(creature(), 300000, 3),
                                                        pair_.truth.inverse())),
                     cloudOf<pcl::PointXYZ>(sampled(creature(), 300000, 4)),
                     pair_.truth};
  struct Trial {
    const char* name;
    pcl::kss::Settings settings;
  };
  const pcl::kss::Settings usual;
  pcl::kss::Settings part = pcl::kss::paperSettings({});
  part.mode = pcl::kss::Mode::PARTIAL_GLOBAL;
  pcl::kss::Settings all_pairs = part;
  all_pairs.search = pcl::kss::brute_force;
  pcl::kss::Settings on_host = part;
  on_host.device = "host";
  for (const Trial& trial : {Trial{"usual", usual}, Trial{"paper", part},
                             Trial{"all pairs", all_pairs}, Trial{"host", on_host}}) {
    KSSICP registration;
    registration.setSettings(trial.settings);
    setClouds(registration, large);
    registration.setTimeLimit(1e-6);
    registration.align(output_); // the tree of the target, and the kernels
    registration.setTimeLimit(0.0);
    for (const double after : {0.02, 0.1, 0.3, 0.6}) {
      Clock::time_point cancelled;
      std::thread other([&] {
        std::this_thread::sleep_for(std::chrono::duration<double>(after));
        cancelled = Clock::now();
        registration.cancel();
      });
      registration.align(output_);
      const Clock::time_point end = Clock::now();
      other.join();
      if (registration.getFailureCause() != FailureCause::STOPPED)
        continue; // it was faster
      const double latency = std::chrono::duration<double>(end - cancelled).count();
      // two tenths of a second, on a machine that is busy with other things as well
      EXPECT_LT(latency, 1.0) << trial.name << " after " << after << " s";
      std::cout << trial.name << " after " << after << " s: " << latency << " s\n";
    }
  }
}

TEST_F(Stopping, WhateverACallbackThrows)
{
  struct Anything {};
  const std::vector<std::function<void()>> throwers = {
      [] { throw std::runtime_error("enough of it"); }, [] { throw 42; },
      [] { throw Anything(); }};
  for (const auto& thrower : throwers)
    for (const int nth : {0, 3, 6, 9}) {
      fromProgress(nth, thrower);
      const auto cloud = pcl::make_shared<Cloud>(*pair_.source);
      registration_.setInputSource(cloud);
      registration_.setMaxCorrespondenceDistance(5.0);
      ASSERT_NO_THROW(registration_.align(*cloud));
      EXPECT_FALSE(registration_.hasConverged());
      EXPECT_EQ(FailureCause::OTHER, registration_.getFailureCause());
      EXPECT_FALSE(registration_.getFailureReason().empty());
      EXPECT_EQ(cloud, registration_.getInputSource());
      EXPECT_EQ(5.0, registration_.getMaxCorrespondenceDistance());
    }
  setClouds(registration_, pair_);
  registration_.setMaxCorrespondenceDistance(
      std::sqrt(std::numeric_limits<double>::max()));
  expectAsGoodAsNew();
}

TEST_F(Stopping, WhateverAVisualizerThrows)
{
  int calls = 0; // the first one is PCL's, when the callback is registered
  std::function<KSSICP::UpdateVisualizerCallbackSignature> callback =
      [&](const Cloud&, const pcl::Indices&, const Cloud&, const pcl::Indices&) {
        if (calls++ > 0)
          throw 42;
      };
  registration_.registerVisualizationCallback(callback);
  ASSERT_NO_THROW(registration_.align(output_));
  EXPECT_FALSE(registration_.hasConverged());
  EXPECT_EQ(FailureCause::OTHER, registration_.getFailureCause());
  EXPECT_EQ(pair_.source, registration_.getInputSource());
  // and nothing of those clouds is left for others
  calls = std::numeric_limits<int>::min();
  pair_ = pairOf(sampled(creature(), 3000, 80), sampled(creature(), 3500, 81),
                 randomRigid(82));
  setClouds(registration_, pair_);
  expectAsGoodAsNew();
}

TEST_F(Stopping, WithoutThreads)
{
  // OpenCL drivers have threads of their own
  registration_.setDevice("host");
  registration_.setNumberOfThreads(1);
  registration_.align(output_);
  ASSERT_TRUE(registration_.hasConverged());
  const Eigen::Matrix4f expected = registration_.getFinalTransformation();
  registration_.setNumberOfThreads(8);
  const ThreadFaults faults(3);
  ASSERT_NO_THROW(registration_.align(output_));
  EXPECT_TRUE(registration_.hasConverged());
  EXPECT_EQ(expected, registration_.getFinalTransformation());
  EXPECT_GT(faults.refused(), 0);
}

} // namespace
