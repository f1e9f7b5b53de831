/*
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * What the program for many scans tells its processes, and keeps of what they answer.
 */

#include "multiview/scan_job_texts.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <random>

namespace {

using namespace pcl::kss;
using tool::answerFrom;
using tool::jobOf;
using tool::taskFrom;
using tool::textOf;

/** Numbers of all sizes, and those that are none. */
class ScanJobTexts : public testing::Test {
protected:
  double
  number()
  {
    const double special[] = {std::numeric_limits<double>::infinity(),
                              -std::numeric_limits<double>::infinity(),
                              std::numeric_limits<double>::quiet_NaN(),
                              -0.0,
                              std::numeric_limits<double>::denorm_min(),
                              std::numeric_limits<double>::max(),
                              0.1};
    const std::size_t kind = random_() % 20;
    if (kind < std::size(special))
      return special[kind];
    return std::ldexp(std::generate_canonical<double, 60>(random_) - 0.5,
                      static_cast<int>(random_() % 200) - 100);
  }

  template <typename Matrix>
  void
  fill(Matrix& matrix)
  {
    for (Eigen::Index i = 0; i < matrix.size(); ++i)
      matrix.data()[i] = static_cast<typename Matrix::Scalar>(number());
  }

  std::vector<PlacedScan>
  group(std::size_t size)
  {
    std::vector<PlacedScan> scans(size);
    for (PlacedScan& placed : scans) {
      placed.scan = random_();
      fill(placed.pose);
    }
    return scans;
  }

  std::mt19937_64 random_{1};
};

/** The same bits, but for what kind of NaN one is. */
template <typename Number>
bool
same(Number a, Number b)
{
  return std::memcmp(&a, &b, sizeof a) == 0 || (std::isnan(a) && std::isnan(b));
}

template <typename Matrix>
void
expectSame(const Matrix& a, const Matrix& b)
{
  ASSERT_EQ(a.rows(), b.rows());
  ASSERT_EQ(a.cols(), b.cols());
  for (Eigen::Index i = 0; i < a.size(); ++i)
    EXPECT_TRUE(same(a.data()[i], b.data()[i])) << a.data()[i] << ' ' << b.data()[i];
}

void
expectSame(const std::vector<PlacedScan>& a, const std::vector<PlacedScan>& b)
{
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].scan, b[i].scan);
    expectSame(a[i].pose, b[i].pose);
  }
}

TEST_F(ScanJobTexts, TasksAreReadAsTheyWereWritten)
{
  for (const auto kind :
       {ScanTask::Kind::DESCRIBE, ScanTask::Kind::REGISTER, ScanTask::Kind::TRY,
        ScanTask::Kind::CONNECT, ScanTask::Kind::STEP}) {
    ScanTask task;
    task.kind = kind;
    task.source = 7;
    task.target = std::numeric_limits<std::size_t>::max();
    if (kind == ScanTask::Kind::STEP)
      fill(task.pose);
    if (kind == ScanTask::Kind::CONNECT) {
      task.source_group = group(3);
      task.target_group = group(2);
      task.estimates_scale = true;
    }
    const std::string job = jobOf(task);
    EXPECT_EQ(std::string::npos, job.find('\n'));
    const ScanTask read = taskFrom(job);
    EXPECT_EQ(kind, read.kind);
    EXPECT_EQ(task.source, read.source);
    EXPECT_EQ(task.target, read.target);
    EXPECT_EQ(task.estimates_scale, read.estimates_scale);
    expectSame(task.pose, read.pose);
    expectSame(task.source_group, read.source_group);
    expectSame(task.target_group, read.target_group);
    EXPECT_EQ(job, jobOf(read));
  }
}

TEST_F(ScanJobTexts, DescriptionsAreReadAsTheyWereWritten)
{
  for (const int columns : {0, 40}) {
    ScanAnswer answer;
    ScanDescription& scan = answer.description;
    fill(scan.centroid);
    fill(scan.spread);
    for (int i = 0; i < columns; ++i) {
      fill(scan.outline.emplace_back());
      scan.wide_features.emplace_back().fill(static_cast<std::uint8_t>(5 * i));
      scan.narrow_features.emplace_back().back() = static_cast<std::uint8_t>(255 - i);
    }
    scan.spacing = number();
    scan.gap = number();
    scan.reach = number();
    scan.octave = -3;
    scan.far_points = 12;
    const std::string text = textOf(answer, ScanTask::Kind::DESCRIBE);
    EXPECT_EQ(std::string::npos, text.find('\n'));
    const ScanDescription read = answerFrom(text).description;
    expectSame(scan.centroid, read.centroid);
    expectSame(scan.spread, read.spread);
    ASSERT_EQ(scan.outline.size(), read.outline.size());
    for (int i = 0; i < columns; ++i)
      expectSame(scan.outline[i], read.outline[i]);
    EXPECT_EQ(scan.wide_features, read.wide_features);
    EXPECT_EQ(scan.narrow_features, read.narrow_features);
    EXPECT_TRUE(same(scan.spacing, read.spacing));
    EXPECT_TRUE(same(scan.gap, read.gap));
    EXPECT_TRUE(same(scan.reach, read.reach));
    EXPECT_EQ(scan.octave, read.octave);
    EXPECT_EQ(scan.far_points, read.far_points);
  }
}

TEST_F(ScanJobTexts, PairsAreReadAsTheyWereWritten)
{
  for (const std::size_t poses : {0, 1, 30}) {
    ScanAnswer answer;
    PairResult& pair = answer.pair;
    pair.source = 3;
    pair.target = 9;
    pair.poses.resize(poses);
    for (PairPose& pose : pair.poses) {
      fill(pose.transformation);
      fill(pose.information);
      pose.overlap = {number(), number(), number()};
      pose.log_odds = number();
    }
    pair.confidence = number();
    pair.ambiguous = poses > 1;
    pair.of_groups = poses == 1;
    pair.failure = {FailureCause::INPUT, "they do not fit"};
    const PairResult read = answerFrom(textOf(answer, ScanTask::Kind::CONNECT)).pair;
    EXPECT_EQ(pair.source, read.source);
    EXPECT_EQ(pair.target, read.target);
    EXPECT_TRUE(same(pair.confidence, read.confidence));
    EXPECT_EQ(pair.ambiguous, read.ambiguous);
    EXPECT_EQ(pair.of_groups, read.of_groups);
    EXPECT_EQ(pair.failure.cause, read.failure.cause);
    EXPECT_EQ(pair.failure.reason, read.failure.reason);
    ASSERT_EQ(poses, read.poses.size());
    for (std::size_t i = 0; i < poses; ++i) {
      expectSame(pair.poses[i].transformation, read.poses[i].transformation);
      expectSame(pair.poses[i].information, read.poses[i].information);
      EXPECT_TRUE(same(pair.poses[i].overlap.source, read.poses[i].overlap.source));
      EXPECT_TRUE(same(pair.poses[i].overlap.target, read.poses[i].overlap.target));
      EXPECT_TRUE(same(pair.poses[i].overlap.score, read.poses[i].overlap.score));
      EXPECT_TRUE(same(pair.poses[i].log_odds, read.poses[i].log_odds));
    }
  }
}

TEST_F(ScanJobTexts, ReasonsMayQuoteAnything)
{
  ScanAnswer answer;
  answer.failure = {FailureCause::INPUT, "sc\xe4n\xff.ply:\n\"\0\x1b"};
  for (const auto kind : {ScanTask::Kind::DESCRIBE, ScanTask::Kind::REGISTER}) {
    const std::string text = textOf(answer, kind);
    EXPECT_EQ(std::string::npos, text.find('\n'));
    const Failure read = answerFrom(text).failure;
    EXPECT_EQ(FailureCause::INPUT, read.cause);
    EXPECT_EQ("sc\xef\xbf\xbdn\xef\xbf\xbd.ply:\n\"", read.reason);
  }
}

TEST_F(ScanJobTexts, OtherLinesAreErrors)
{
  for (const char* line : {"", "{", "[]", "{}", "3", "{\"kind\": \"x\"}"})
    EXPECT_ANY_THROW(taskFrom(line)) << line;
  for (const char* line : {"", "{", "[]", "{}", "3", "{\"failure\": 3}"})
    EXPECT_ANY_THROW(answerFrom(line)) << line;
  ScanTask task;
  task.kind = ScanTask::Kind::STEP;
  std::string job = jobOf(task);
  job.replace(job.find("[1.0,"), 5, "[");
  EXPECT_ANY_THROW(taskFrom(job)) << job;
}

} // namespace
