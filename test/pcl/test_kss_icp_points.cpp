/*
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * The points that KSSICP takes: those that indices name, those that are finite; and
 * those of a source that the output overwrites.
 */

#include "trial.h"

#include <pcl/common/transforms.h>

#include <limits>

namespace {

using namespace kss_test;

TEST(KSSICP, RespectsIndices)
{
  // every other point is clutter far from the shape
  auto pair = pairOf(randomSimilarity(9));
  const Cloud shape = *pair.source;
  const Points clutter = scattered(shape.size(), 10) * 30.0f;
  const auto mixed = pcl::make_shared<Cloud>();
  const auto indices = pcl::make_shared<pcl::Indices>();
  for (std::size_t i = 0; i < shape.size(); ++i) {
    mixed->push_back({clutter(0, i), clutter(1, i), clutter(2, i)});
    indices->push_back(static_cast<pcl::index_t>(mixed->size()));
    mixed->push_back(shape[i]);
  }
  mixed->header.frame_id = "scanner";
  Trial trial(pair);
  trial.registration.setInputSource(mixed);
  trial.registration.setIndices(indices);
  const Eigen::Matrix4f found = trial.align();
  EXPECT_TRUE(trial.registration.hasConverged());
  expectRight(trial.registration, pair);
  EXPECT_EQ(shape.size(), trial.output.width);
  EXPECT_EQ(1u, trial.output.height);
  EXPECT_EQ("scanner", trial.output.header.frame_id);
  expectTransformed(trial.output, shape, found);
  // the same as for a cloud that holds nothing else
  EXPECT_EQ(Trial(pair).align(), found);
  EXPECT_NEAR(meanSquaredDistance(trial.output, *pair.target, 1e30),
              trial.registration.getFitnessScore(), 1e-6);
  // with the others, which lie far away
  Cloud all;
  pcl::transformPointCloud(*mixed, all, found);
  const double score = meanSquaredDistance(all, *pair.target, 1e30);
  EXPECT_GT(score, 1.0);
  EXPECT_NEAR(score, trial.registration.getFitnessScore(1e30, false), 1e-5 * score);
  // correspondences name the points of the cloud that was set
  ASSERT_FALSE(trial.registration.correspondences().empty());
  for (const pcl::Correspondence& match : trial.registration.correspondences())
    EXPECT_EQ(1, match.index_query % 2);

  // the other ways of naming indices
  const auto named = pcl::make_shared<pcl::PointIndices>();
  named->indices = *indices;
  trial.registration.setIndices(pcl::PointIndices::ConstPtr(named));
  EXPECT_EQ(found, trial.align());
  trial.registration.setIndices(pcl::IndicesConstPtr(indices));
  EXPECT_EQ(found, trial.align());
  // indices belong to a cloud: the next, smaller one is checked against them
  trial.registration.setInputSource(pair.source);
  trial.align();
  EXPECT_FALSE(trial.registration.hasConverged());
  trial.registration.setIndices(pcl::IndicesPtr());
  EXPECT_EQ(found, trial.align());
}

TEST(KSSICP, TakesMoreIndicesThanPoints)
{
  // PCL asserts that there are not where it copies the points that indices name
  const auto pair = pairOf(randomSimilarity(34));
  const auto indices = pcl::make_shared<pcl::Indices>();
  for (int times = 0; times < 2; ++times)
    for (std::size_t i = 0; i < pair.source->size(); ++i)
      indices->push_back(static_cast<pcl::index_t>(i));
  Trial trial(pair);
  trial.registration.setIndices(indices);
  trial.align();
  EXPECT_TRUE(trial.registration.hasConverged());
  EXPECT_EQ(indices->size(), trial.output.size());
  expectRight(trial.registration, pair);
}

TEST(KSSICP, RespectsAsManyIndicesAsPoints)
{
  const auto pair = pairOf(randomSimilarity(34));
  const auto size = static_cast<pcl::index_t>(pair.source->size());
  // in the opposite order
  const auto reversed = pcl::make_shared<pcl::Indices>();
  for (pcl::index_t i = size; i-- > 0;)
    reversed->push_back(i);
  Trial trial(pair);
  trial.registration.setIndices(reversed);
  trial.align();
  EXPECT_TRUE(trial.registration.hasConverged());
  expectRight(trial.registration, pair);
  expectTransformed(trial.output, picked(*pair.source, *reversed),
                    trial.registration.getFinalTransformation());
  // half of the points, each twice; the other half is far off
  Pair<> half = pair;
  half.source = pcl::make_shared<Cloud>(*pair.source);
  const auto twice = pcl::make_shared<pcl::Indices>();
  for (pcl::index_t i = 0; i + 1 < size; i += 2) {
    twice->insert(twice->end(), {i, i});
    (*half.source)[i + 1].getVector3fMap() *= 50.0f;
  }
  setClouds(trial.registration, half);
  trial.registration.setIndices(twice);
  trial.align();
  EXPECT_TRUE(trial.registration.hasConverged());
  EXPECT_LT(displacement(poseFrom(trial.registration), pair.truth,
                         pointsOf(picked(*half.source, *twice))),
            0.02);
  EXPECT_NEAR(meanSquaredDistance(trial.output, *pair.target, 1e30),
              trial.registration.getFitnessScore(), 1e-6);
  for (const pcl::Correspondence& match : trial.registration.correspondences())
    EXPECT_EQ(0, match.index_query % 2);
}

TEST(KSSICP, SkipsPointsThatAreNotFinite)
{
  auto pair = pairOf(randomSimilarity(11));
  const Eigen::Matrix4f expected = Trial(pair).align();
  const auto holes = [](const Cloud& cloud) {
    // an organised cloud, as a depth camera gives it, with a third of its points void
    const auto holed = pcl::make_shared<Cloud>();
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      holed->push_back(cloud[i]);
      if (i % 2 == 0) {
        pcl::PointXYZ nothing = cloud[i];
        if (i % 4 == 0)
          makeNaN(nothing);
        else
          nothing.y = std::numeric_limits<float>::infinity();
        holed->push_back(nothing);
      }
    }
    holed->width = holed->size() / 3;
    holed->height = 3;
    holed->is_dense = false;
    return holed;
  };
  pair.source = holes(*pair.source);
  pair.target = holes(*pair.target);
  Trial trial(pair);
  EXPECT_EQ(expected, trial.align());
  EXPECT_TRUE(trial.registration.hasConverged());
  EXPECT_EQ(pair.source->width, trial.output.width);
  EXPECT_EQ(3u, trial.output.height);
  EXPECT_FALSE(trial.output.is_dense);
  expectTransformed(trial.output, *pair.source, expected);
  EXPECT_NEAR(meanSquaredDistance(trial.output, *pair.target, 1e30),
              trial.registration.getFitnessScore(), 1e-6);
  // and where indices name some of them
  const auto half = pcl::make_shared<pcl::Indices>();
  for (std::size_t i = 0; i < pair.source->size(); i += 2)
    half->push_back(static_cast<pcl::index_t>(i));
  trial.registration.setIndices(half);
  trial.align();
  EXPECT_TRUE(trial.registration.hasConverged());
  expectRight(trial.registration, pair, 0.02);
  expectTransformed(trial.output, picked(*pair.source, *half),
                    trial.registration.getFinalTransformation());
}

TEST(KSSICP, MayOverwriteItsSource)
{
  auto pair = pairOf(randomSimilarity(12));
  const Cloud before = *pair.source;
  Trial reference(pair);
  const Eigen::Matrix4f expected = reference.align();
  const double score = reference.registration.getFitnessScore();
  Trial trial(pair);
  trial.registration.align(*pair.source);
  EXPECT_TRUE(trial.registration.hasConverged());
  EXPECT_EQ(expected, trial.registration.getFinalTransformation());
  expectTransformed(*pair.source, before, expected);
  EXPECT_EQ(pair.source, trial.registration.getInputSource());
  EXPECT_NEAR(score, trial.registration.getFitnessScore(), 1e-6);
  // once more: now there is nothing left to do
  trial.registration.align(*pair.source);
  EXPECT_TRUE(trial.registration.hasConverged());
  EXPECT_LT(displacement(poseFrom(trial.registration), Eigen::Matrix4d::Identity(),
                         pointsOf(*pair.source)),
            0.01);
}

TEST(KSSICP, MayOverwriteItsSourceWithTheIndexedPart)
{
  auto pair = pairOf(randomSimilarity(13));
  const auto odd = pcl::make_shared<pcl::Indices>();
  for (std::size_t i = 1; i < pair.source->size(); i += 2)
    odd->push_back(static_cast<pcl::index_t>(i));
  const Cloud before = picked(*pair.source, *odd);
  Trial trial(pair);
  trial.registration.setIndices(odd);
  const Eigen::Matrix4f expected = trial.align();
  const double score = trial.registration.getFitnessScore();
  trial.registration.align(*pair.source);
  EXPECT_EQ(expected, trial.registration.getFinalTransformation());
  expectTransformed(*pair.source, before, expected);
  EXPECT_NEAR(score, trial.registration.getFitnessScore(), 1e-6);
}

} // namespace
