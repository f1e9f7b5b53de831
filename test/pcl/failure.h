/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "pairs.h"

#include <string>

namespace kss_test {

using KSSICP = pcl::KSSICP<pcl::PointXYZ, pcl::PointXYZ>;
using Cloud = pcl::PointCloud<pcl::PointXYZ>;

inline const Eigen::Matrix4f identity = Eigen::Matrix4f::Identity();

/** \brief A registration that would succeed, until a test takes something from it. */
class Failure : public ::testing::Test {
protected:
  Failure()
  : pair_(pairOf(randomSimilarity(1)))
  {
    makeQuick(registration_);
    setClouds(registration_, pair_);
  }

  /** \brief Aligns, and expects a failure that leaves nothing undone. */
  void
  expectFailure(const Eigen::Matrix4f& guess = identity)
  {
    ASSERT_NO_THROW(registration_.align(output_, guess));
    EXPECT_FALSE(registration_.hasConverged());
    EXPECT_FALSE(registration_.getFailureReason().empty());
    EXPECT_EQ(guess, registration_.getFinalTransformation());
    EXPECT_EQ(identity, registration_.getLastIncrementalTransformation());
    EXPECT_EQ(0.0, registration_.getOverlap().score);
    EXPECT_LT(registration_.getConfidence(), 1e-3);
    EXPECT_FALSE(registration_.isAmbiguous());
    EXPECT_TRUE(registration_.getAlternatives().empty());
  }

  /** \brief The same for a source that can be transformed, with a guess and without. */
  void
  expectFailureThatTransforms(const Cloud& source)
  {
    expectFailure();
    expectTransformed(output_, source, identity);
    const Eigen::Matrix4f guess = randomSimilarity(2).cast<float>();
    expectFailure(guess);
    expectTransformed(output_, source, guess);
  }

  void
  expectReason(const std::string& part)
  {
    EXPECT_NE(std::string::npos, registration_.getFailureReason().find(part))
        << registration_.getFailureReason();
  }

  /** \brief The object is as good as new when it is given what it needs. */
  void
  expectRecovery()
  {
    setClouds(registration_, pair_);
    registration_.align(output_);
    EXPECT_TRUE(registration_.hasConverged());
    EXPECT_EQ("", registration_.getFailureReason());
    expectRight(registration_, pair_);
  }

  const Pair<> pair_;
  KSSICP registration_;
  Cloud output_;
};

} // namespace kss_test
