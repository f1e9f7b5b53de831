/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "body.h"

#include "multiview/placement_of_scans.h"

#include <pcl/registration/kss/scan_work.h>

#include <gtest/gtest.h>

#include <stdexcept>

using namespace pcl::kss;
using made_up::Body;

namespace {

/** Scans of two bodies, five of the one from around it, and two of the other. */
class ConnectScans : public testing::Test {
protected:
  ConnectScans()
  {
    Body one(1), other(2);
    for (int i = 0; i < 7; ++i) {
      const double angle = (i < 5 ? i : i - 5) * 2.0 * M_PI / 5.0;
      Body& body = i < 5 ? one : other;
      T_scan_body.push_back(body.randomPose());
      Cloud cloud;
      cloud.points = body.seenFrom({std::cos(angle), std::sin(angle), 0.3},
                                   T_scan_body.back(), 2000);
      clouds.push_back(cloud);
    }
    settings.device = "host";
    settings.estimate_scale = false;
  }

  ScanLoader
  loader() const
  {
    return [this](std::size_t number) {
      return std::make_shared<Cloud>(clouds.at(number));
    };
  }

  Multiview
  connected(unsigned int threads, std::size_t room = std::size_t(1) << 30) const
  {
    ScanWorker worker(settings, loader(), room);
    ThreadCrew crew(worker, threads);
    return connectScans(clouds.size(), {}, crew);
  }

  /** How far a scan is off where the model has placed it, beside the first one of its
   * group. */
  double
  errorOf(const Multiview& model, std::size_t first, std::size_t scan) const
  {
    ScanDescription description;
    description.spread = Eigen::Matrix3d::Identity() / 3.0;
    description.centroid = clouds[scan].points.rowwise().mean();
    return displacement(description,
                        inverted(model.scans[first].transformation) *
                            Eigen::Matrix4d(model.scans[scan].transformation),
                        T_scan_body[first] * inverted(T_scan_body[scan]));
  }

  void
  expectRight(const Multiview& model) const
  {
    EXPECT_EQ(model.failure.reason, "");
    ASSERT_EQ(model.groups,
              (std::vector<std::vector<std::size_t>>{{0, 1, 2, 3, 4}, {5, 6}}));
    for (std::size_t scan : {1, 2, 3, 4})
      EXPECT_LT(errorOf(model, 0, scan), 0.02) << scan;
    EXPECT_LT(errorOf(model, 5, 6), 0.02);
    EXPECT_TRUE(Eigen::Matrix4d(model.scans[0].transformation).isIdentity(1e-12));
    EXPECT_TRUE(Eigen::Matrix4d(model.scans[5].transformation).isIdentity(1e-12));
    for (const GraphPair& pair : model.pairs) {
      const bool is_of_one_body = (pair.result.source < 5) == (pair.result.target < 5);
      EXPECT_TRUE(pair.verdict != PairVerdict::KEPT || is_of_one_body);
      EXPECT_EQ(pair.reason.empty(), pair.verdict == PairVerdict::KEPT);
    }
  }

  std::vector<Eigen::Matrix4d> T_scan_body;
  std::vector<Cloud> clouds;
  Settings settings;
};

/** A crew some of whose pairs are wrong, and sure of it. */
class WrongCrew : public ScanCrew {
public:
  WrongCrew(ScanWorker& worker, std::size_t source, std::size_t target)
  : crew_(worker, 0)
  , source_(source)
  , target_(target)
  {
  }

  void
  work(const std::vector<ScanTask>& tasks,
       const std::function<void(std::size_t, ScanAnswer)>& done) override
  {
    crew_.work(tasks, [&](std::size_t number, ScanAnswer answer) {
      const ScanTask& task = tasks[number];
      if (task.kind != ScanTask::Kind::STEP && task.source == source_ &&
          task.target == target_) {
        answer.pair.poses.assign(1, {});
        answer.pair.poses.front().transformation(0, 3) = 0.7;
        answer.pair.confidence = 1.0;
        answer.pair.failure = {};
      }
      done(number, std::move(answer));
    });
  }

private:
  ThreadCrew crew_;
  std::size_t source_, target_;
};

TEST_F(ConnectScans, FindsBodiesAndPoses)
{
  expectRight(connected(0));
}

TEST_F(ConnectScans, IsTheSameForAnyNumberOfThreadsAndAnyRoom)
{
  clouds.resize(4);
  const Multiview one = connected(1), three = connected(3, 1);
  ASSERT_EQ(one.scans.size(), three.scans.size());
  for (std::size_t i = 0; i < one.scans.size(); ++i)
    EXPECT_EQ(one.scans[i].transformation, three.scans[i].transformation) << i;
  ASSERT_EQ(one.pairs.size(), three.pairs.size());
  for (std::size_t i = 0; i < one.pairs.size(); ++i) {
    EXPECT_EQ(one.pairs[i].result.confidence, three.pairs[i].result.confidence);
    EXPECT_EQ(one.pairs[i].deviation, three.pairs[i].deviation);
  }
}

TEST_F(ConnectScans, RejectsAWrongPairThatIsSure)
{
  // closer to each other, so that ways by a third scan tell
  Body body(1);
  for (int i = 0; i < 7; ++i)
    clouds[i].points = body.seenFrom({std::cos(0.5 * i), std::sin(0.5 * i), 0.3},
                                     T_scan_body[i], 2000);
  ScanWorker worker(settings, loader(), std::size_t(1) << 30);
  WrongCrew crew(worker, 0, 1);
  const Multiview model = connectScans(clouds.size(), {}, crew);
  ASSERT_EQ(model.groups.size(), 1);
  for (std::size_t scan = 1; scan < 7; ++scan)
    EXPECT_LT(errorOf(model, 0, scan), 0.02) << scan;
  const GraphPair& wrong = model.pairs.front();
  ASSERT_EQ(wrong.result.source, 0);
  ASSERT_EQ(wrong.result.target, 1);
  EXPECT_EQ(wrong.verdict, PairVerdict::REJECTED);
  EXPECT_GT(wrong.deviation, 0.3);
}

TEST_F(ConnectScans, GoesOnWithoutScansThatCannotBeHad)
{
  clouds.resize(3);
  clouds[0].points.resize(3, 0);
  ScanWorker worker(
      settings,
      [this](std::size_t number) {
        if (number == 3)
          throw std::runtime_error("scan.ply: there is no such file");
        return std::make_shared<Cloud>(clouds.at(number));
      },
      std::size_t(1) << 30);
  ThreadCrew crew(worker, 0);
  const Multiview model = connectScans(4, {}, crew);
  EXPECT_EQ(model.groups, (std::vector<std::vector<std::size_t>>{{1, 2}, {0}, {3}}));
  EXPECT_NE(model.scans[0].failure.reason.find("no finite points"), std::string::npos)
      << model.scans[0].failure.reason;
  EXPECT_EQ(model.scans[3].failure.reason, "scan.ply: there is no such file");
  EXPECT_EQ(model.scans[1].failure.cause, FailureCause::NONE);
  EXPECT_EQ(model.pairs.size(), 1);
}

TEST_F(ConnectScans, HasNothingToDoWithNoScans)
{
  clouds.clear();
  const Multiview model = connected(1);
  EXPECT_EQ(model.failure.reason, "");
  EXPECT_TRUE(model.scans.empty());
  EXPECT_TRUE(model.groups.empty());
}

} // namespace
