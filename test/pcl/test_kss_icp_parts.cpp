/*
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * What a caller gives KSSICP to call: callbacks, estimators and rejectors.
 */

#include "trial.h"

#include <pcl/registration/transformation_estimation_svd_scale.h>

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace {

using namespace kss_test;

TEST(KSSICP, ReportsItsProgress)
{
  const auto pair = pairOf(randomSimilarity(30));
  Trial trial(pair);
  std::map<std::string, double> done;
  std::vector<std::string> order;
  trial.registration.setProgressCallback([&](const std::string& stage, double share) {
    if (order.empty() || order.back() != stage)
      order.push_back(stage);
    else
      EXPECT_GE(share, done[stage]) << stage << " goes backwards";
    EXPECT_GE(share, 0.0);
    EXPECT_LE(share, 1.0);
    done[stage] = share;
  });
  const std::vector<std::string> stages{"preparation", "simplification", "search",
                                        "refinement", "final ICP"};
  trial.align();
  EXPECT_EQ(stages, order);
  for (const auto& stage : done)
    EXPECT_EQ(1.0, stage.second) << stage.first;
  // with a guess there is more than one run of ICP, but still one stage of it
  order.clear();
  done.clear();
  trial.align(pair.truth);
  EXPECT_EQ(stages, order);
  // nor does the additional process start anew
  order.clear();
  done.clear();
  set(trial.registration, &pcl::kss::Settings::additional_process_threshold, 1e-6);
  trial.align();
  EXPECT_EQ(stages, order);
  trial.registration.setProgressCallback({});
  trial.align();
  EXPECT_TRUE(trial.registration.hasConverged());
}

TEST(KSSICP, CallsTheVisualiserWithEveryIteration)
{
  const auto pair = pairOf(randomSimilarity(31));
  int calls = 0;
  std::function<KSSICP::UpdateVisualizerCallbackSignature> callback =
      [&](const Cloud& source, const pcl::Indices& source_indices, const Cloud& target,
          const pcl::Indices& target_indices) {
        ++calls;
        EXPECT_EQ(pair.source->size(), source.size());
        EXPECT_EQ(pair.target->size(), target.size());
        EXPECT_EQ(source_indices.size(), target_indices.size());
      };
  // before the clouds are known: PCL's own would dereference null pointers
  Trial trial(pair);
  Open early;
  makeQuick(early);
  EXPECT_TRUE(early.registerVisualizationCallback(callback));
  setClouds(early, pair);
  const int before = calls;
  Cloud output;
  early.align(output);
  EXPECT_GE(calls - before, early.iterations());
  EXPECT_GT(early.iterations(), 0);
  std::function<KSSICP::UpdateVisualizerCallbackSignature> none;
  EXPECT_FALSE(trial.registration.registerVisualizationCallback(none));
  EXPECT_TRUE(trial.registration.registerVisualizationCallback(callback));
}

/** Counts how often ICP asks for a transformation. */
class CountedEstimation
: public pcl::registration::TransformationEstimationSVDScale<pcl::PointXYZ,
                                                             pcl::PointXYZ> {
public:
  void
  estimateRigidTransformation(const Cloud& source,
                              const Cloud& target,
                              const pcl::Correspondences& correspondences,
                              Matrix4& matrix) const override
  {
    ++calls;
    pcl::registration::TransformationEstimationSVDScale<
        pcl::PointXYZ, pcl::PointXYZ>::estimateRigidTransformation(source, target,
                                                                   correspondences,
                                                                   matrix);
  }
  mutable int calls = 0;
};

/** Counts the ways in which ICP asks for correspondences. */
class CountedCorrespondences
: public pcl::registration::CorrespondenceEstimation<pcl::PointXYZ, pcl::PointXYZ> {
  using Base =
      pcl::registration::CorrespondenceEstimation<pcl::PointXYZ, pcl::PointXYZ>;

public:
  void
  determineCorrespondences(pcl::Correspondences& correspondences,
                           double max_distance) override
  {
    ++calls;
    Base::determineCorrespondences(correspondences, max_distance);
  }
  void
  determineReciprocalCorrespondences(pcl::Correspondences& correspondences,
                                     double max_distance) override
  {
    ++reciprocal_calls;
    Base::determineReciprocalCorrespondences(correspondences, max_distance);
  }
  int calls = 0, reciprocal_calls = 0;
};

/** Lets every other correspondence pass, or none. */
class CountedRejector : public pcl::registration::CorrespondenceRejector {
public:
  explicit CountedRejector(bool rejects_all)
  : rejects_all_(rejects_all)
  {
  }
  void
  getRemainingCorrespondences(const pcl::Correspondences& all,
                              pcl::Correspondences& remaining) override
  {
    ++calls;
    remaining.clear();
    for (std::size_t i = 0; i < all.size() && !rejects_all_; i += 2)
      remaining.push_back(all[i]);
  }
  int calls = 0;

protected:
  void
  applyRejection(pcl::Correspondences& remaining) override
  {
    getRemainingCorrespondences(*input_correspondences_, remaining);
  }

private:
  bool rejects_all_;
};

TEST(KSSICP, UsesTheEstimatorsItIsGiven)
{
  const auto pair = pairOf(randomSimilarity(32));
  Trial trial(pair);
  const auto transformation = pcl::make_shared<CountedEstimation>();
  const auto correspondences = pcl::make_shared<CountedCorrespondences>();
  trial.registration.setTransformationEstimation(transformation);
  trial.registration.setCorrespondenceEstimation(correspondences);
  trial.align();
  EXPECT_TRUE(trial.registration.hasConverged());
  expectRight(trial.registration, pair, 0.02);
  EXPECT_GT(transformation->calls, 0);
  EXPECT_GE(correspondences->calls, transformation->calls);
  EXPECT_EQ(0, correspondences->reciprocal_calls);

  const int plain_calls = correspondences->calls;
  trial.registration.setUseReciprocalCorrespondences(true);
  trial.align();
  EXPECT_TRUE(trial.registration.hasConverged());
  EXPECT_EQ(plain_calls, correspondences->calls);
  EXPECT_GT(correspondences->reciprocal_calls, 0);
}

TEST(KSSICP, UsesTheRejectorsItIsGiven)
{
  const auto pair = pairOf(randomSimilarity(33));
  Trial trial(pair);
  const auto half = pcl::make_shared<CountedRejector>(false);
  trial.registration.addCorrespondenceRejector(half);
  EXPECT_EQ(1u, trial.registration.getCorrespondenceRejectors().size());
  trial.align();
  EXPECT_TRUE(trial.registration.hasConverged());
  expectRight(trial.registration, pair);
  EXPECT_GT(half->calls, 0);
  EXPECT_EQ(pair.source->size() / 2, trial.registration.correspondences().size());

  EXPECT_FALSE(trial.registration.removeCorrespondenceRejector(1));
  EXPECT_TRUE(trial.registration.removeCorrespondenceRejector(0));
  EXPECT_TRUE(trial.registration.getCorrespondenceRejectors().empty());
  trial.registration.addCorrespondenceRejector(pcl::make_shared<CountedRejector>(true));
  const Eigen::Matrix4d guess = pair.truth;
  EXPECT_EQ(guess.cast<float>(), trial.align(guess));
  EXPECT_FALSE(trial.registration.hasConverged());
  trial.registration.clearCorrespondenceRejectors();
  trial.align();
  EXPECT_TRUE(trial.registration.hasConverged());
}

} // namespace
