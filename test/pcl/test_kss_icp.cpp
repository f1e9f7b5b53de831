/*
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * KSSICP where all goes well: in the place of IterativeClosestPoint, call by call.
 */

#include "pairs.h"

#include <pcl/registration/kss/detail/cloud_conversion.h>
#include <pcl/registration/transformation_estimation_svd_scale.h>

#include <map>

namespace {

using namespace kss_test;
using KSSICP = pcl::KSSICP<pcl::PointXYZ, pcl::PointXYZ>;
using ICP = pcl::IterativeClosestPoint<pcl::PointXYZ, pcl::PointXYZ>;
using Registration = pcl::Registration<pcl::PointXYZ, pcl::PointXYZ>;
using Cloud = pcl::PointCloud<pcl::PointXYZ>;

/** KSSICP with what it keeps for subclasses in sight. */
class Open : public KSSICP {
public:
  const pcl::Correspondences&
  correspondences() const
  {
    return *correspondences_;
  }
  int
  iterations() const
  {
    return nr_iterations_;
  }
};

/** Members of IterativeClosestPoint's that have to be as public here as there. */
template <typename T, typename = void>
struct HasPublicClassName : std::false_type {
};
template <typename T>
struct HasPublicClassName<T, std::void_t<decltype(std::declval<T&>().getClassName())>>
: std::true_type {
};
template <typename T, typename = void>
struct HasPublicCriteria : std::false_type {
};
template <typename T>
struct HasPublicCriteria<
    T,
    std::void_t<decltype(std::declval<T&>().convergence_criteria_)>> : std::true_type {
};

/** The mean squared distance to the nearest target points, by brute force. */
double
meanSquaredDistance(const Cloud& aligned, const Cloud& target, double max_range)
{
  const Eigen::Matrix3Xd targets = pointsOf(target).cast<double>();
  double sum = 0.0;
  int pairs = 0;
  for (const pcl::PointXYZ& point : aligned) {
    if (!point.getVector3fMap().allFinite())
      continue;
    double nearest = std::numeric_limits<double>::max();
    for (Eigen::Index i = 0; i < targets.cols(); ++i)
      if (targets.col(i).allFinite())
        nearest = std::min(
            nearest,
            (targets.col(i) - point.getVector3fMap().cast<double>()).squaredNorm());
    if (nearest <= max_range) {
      sum += nearest;
      ++pairs;
    }
  }
  return pairs > 0 ? sum / pairs : std::numeric_limits<double>::max();
}

/** The registration of a pair, with its output. */
struct Trial {
  Open registration;
  Cloud output;

  explicit Trial(const Pair<>& pair)
  {
    makeQuick(registration);
    setClouds(registration, pair);
  }

  Eigen::Matrix4f
  align()
  {
    registration.align(output);
    return registration.getFinalTransformation();
  }

  Eigen::Matrix4f
  align(const Eigen::Matrix4d& guess)
  {
    registration.align(output, guess.cast<float>());
    return registration.getFinalTransformation();
  }
};

TEST(KSSICP, RegistersWithoutAGuess)
{
  for (unsigned int seed = 0; seed < 4; ++seed) {
    const auto pair = pairOf(randomSimilarity(seed), seed);
    Trial trial(pair);
    trial.align();
    EXPECT_TRUE(trial.registration.hasConverged());
    EXPECT_EQ("", trial.registration.getFailureReason());
    expectRight(trial.registration, pair);
    expectTransformed(trial.output, *pair.source,
                      trial.registration.getFinalTransformation());
    EXPECT_NEAR(scaleIn(pair.truth), trial.registration.getScale(),
                0.01 * scaleIn(pair.truth));
    EXPECT_NEAR(scaleIn(poseFrom(trial.registration)), trial.registration.getScale(),
                1e-5);
  }
}

TEST(KSSICP, RegistersWithItsDefaultsAndTheEulerGrid)
{
  const auto pair = pairOf(randomSimilarity(5));
  KSSICP registration;
  setClouds(registration, pair);
  Cloud output;
  registration.align(output);
  EXPECT_TRUE(registration.hasConverged());
  expectRight(registration, pair);
  makeQuick(registration);
  set(registration, &pcl::kss::Settings::rotation_set, pcl::kss::RotationSet::EULER);
  set(registration, &pcl::kss::Settings::density, pcl::kss::Density::PAPER);
  registration.align(output);
  EXPECT_TRUE(registration.hasConverged());
  expectRight(registration, pair);
}

TEST(KSSICP, TellsHowItWent)
{
  const auto pair = pairOf(randomSimilarity(6));
  Trial trial(pair);
  auto& registration = trial.registration;
  EXPECT_EQ(0.0, registration.getOverlap().score);
  EXPECT_EQ(0.0, registration.getOverlap().source);
  EXPECT_EQ(0.0, registration.getOverlap().target);
  EXPECT_LT(registration.getConfidence(), 1e-3);
  EXPECT_FALSE(registration.isAmbiguous());
  EXPECT_FALSE(registration.hasConverged());
  trial.align();

  const auto& alternatives = registration.getAlternatives();
  ASSERT_FALSE(alternatives.empty());
  EXPECT_EQ(poseFrom(registration), alternatives.front().transformation);
  EXPECT_EQ(registration.getOverlap().score, alternatives.front().overlap.score);
  // the result, then the others by falling score
  for (std::size_t i = 2; i < alternatives.size(); ++i)
    EXPECT_GE(alternatives[i - 1].overlap.score, alternatives[i].overlap.score);
  EXPECT_NEAR(1.5, registration.getOverlap().score, 0.15);
  EXPECT_GT(registration.getOverlap().source, 0.95);
  EXPECT_GT(registration.getOverlap().target, 0.95);
  EXPECT_GT(registration.getConfidence(), 0.99);
  EXPECT_FALSE(registration.isAmbiguous());
  EXPECT_FALSE(registration.getDeviceName().empty());

  std::vector<std::string> stages;
  for (const auto& stage : registration.getStageSeconds()) {
    stages.push_back(stage.stage);
    EXPECT_GE(stage.seconds, 0.0);
  }
  EXPECT_EQ((std::vector<std::string>{"preparation", "simplification", "search",
                                      "refinement", "final ICP"}),
            stages);
  registration.setDevice("host");
  trial.align();
  EXPECT_EQ("host", registration.getDeviceName());
  EXPECT_EQ(5u, registration.getStageSeconds().size());
}

TEST(KSSICP, HasTheInterfaceOfIterativeClosestPoint)
{
  const auto pair = pairOf(randomSimilarity(7));
  KSSICP registration;
  EXPECT_TRUE(HasPublicClassName<ICP>::value);
  EXPECT_TRUE(HasPublicClassName<KSSICP>::value);
  EXPECT_TRUE(HasPublicCriteria<ICP>::value);
  EXPECT_TRUE(HasPublicCriteria<KSSICP>::value);
  ICP& as_icp = registration;
  EXPECT_EQ("KSSICP", as_icp.getClassName());
  EXPECT_EQ(300, registration.getMaximumIterations());
  EXPECT_EQ(1e-5, registration.getEuclideanFitnessEpsilon());
  EXPECT_EQ(0.0, registration.getTransformationEpsilon());

  registration.setMaximumIterations(60);
  EXPECT_EQ(60, registration.getMaximumIterations());
  registration.setRANSACIterations(7);
  EXPECT_EQ(7, registration.getRANSACIterations());
  registration.setRANSACOutlierRejectionThreshold(0.3);
  EXPECT_EQ(0.3, registration.getRANSACOutlierRejectionThreshold());
  registration.setMaxCorrespondenceDistance(5.0);
  EXPECT_EQ(5.0, registration.getMaxCorrespondenceDistance());
  registration.setTransformationEpsilon(1e-14);
  EXPECT_EQ(1e-14, registration.getTransformationEpsilon());
  registration.setTransformationRotationEpsilon(0.9999999);
  EXPECT_EQ(0.9999999, registration.getTransformationRotationEpsilon());
  registration.setEuclideanFitnessEpsilon(1e-6);
  EXPECT_EQ(1e-6, registration.getEuclideanFitnessEpsilon());
  registration.setUseReciprocalCorrespondences(true);
  EXPECT_TRUE(registration.getUseReciprocalCorrespondences());
  registration.setPointRepresentation(
      pcl::make_shared<pcl::DefaultPointRepresentation<pcl::PointXYZ>>());
  EXPECT_EQ(as_icp.convergence_criteria_, registration.getConvergeCriteria());

  const auto target_tree = pcl::make_shared<KSSICP::KdTree>();
  registration.setSearchMethodTarget(target_tree);
  EXPECT_EQ(target_tree, registration.getSearchMethodTarget());
  const auto source_tree = pcl::make_shared<KSSICP::KdTreeReciprocal>();
  registration.setSearchMethodSource(source_tree);
  EXPECT_EQ(source_tree, registration.getSearchMethodSource());

  setClouds(registration, pair);
  EXPECT_EQ(pair.source, registration.getInputSource());
  EXPECT_EQ(pair.target, registration.getInputTarget());
  Cloud output;
  registration.align(output);
  EXPECT_TRUE(registration.hasConverged());
  expectRight(registration, pair);
  EXPECT_EQ(pair.target, target_tree->getInputCloud());
  // the last step of a run that has converged is a small one
  EXPECT_TRUE(registration.getLastIncrementalTransformation().isIdentity(1e-3f));
  EXPECT_DOUBLE_EQ(1.5, registration.getFitnessScore({1, 3, 5}, {0, 2, 2.5}));
}

TEST(KSSICP, WorksThroughPointersToItsBases)
{
  const auto pair = pairOf(randomSimilarity(8));
  Trial trial(pair);
  const Eigen::Matrix4f expected = trial.align();

  const auto kss_icp = pcl::make_shared<KSSICP>();
  makeQuick(*kss_icp);
  const Registration::Ptr registration = kss_icp;
  setClouds(*registration, pair);
  Cloud output;
  registration->align(output);
  EXPECT_TRUE(registration->hasConverged());
  EXPECT_EQ(expected, registration->getFinalTransformation());
  expectTransformed(output, *pair.source, expected);
  EXPECT_NEAR(trial.registration.getFitnessScore(), registration->getFitnessScore(),
              1e-6);

  const ICP::Ptr icp = kss_icp;
  icp->setUseReciprocalCorrespondences(false);
  setClouds(*icp, pair);
  icp->align(output, Eigen::Matrix4f::Identity());
  EXPECT_TRUE(icp->hasConverged());
  EXPECT_EQ(expected, icp->getFinalTransformation());
  icp->align(*pair.source);
  expectTransformed(*pair.source, *cloudOf<pcl::PointXYZ>(pointsOf(output)),
                    Eigen::Matrix4f(Eigen::Matrix4f::Identity()));

  // an empty cloud is refused through a base, too
  registration->setInputSource(pcl::make_shared<Cloud>());
  registration->align(output);
  EXPECT_FALSE(registration->hasConverged());
}

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

TEST(KSSICP, CanBeUsedAgainAndAgain)
{
  Trial trial(pairOf(randomSimilarity(14)));
  for (unsigned int seed = 15; seed < 18; ++seed) {
    const auto pair = pairOf(randomSimilarity(seed), seed);
    setClouds(trial.registration, pair);
    const Eigen::Matrix4f found = trial.align();
    EXPECT_TRUE(trial.registration.hasConverged());
    expectRight(trial.registration, pair);
    // nothing of the runs before is left: the same bits as from a new object
    EXPECT_EQ(Trial(pair).align(), found);
    EXPECT_EQ(found, trial.align());
    // a new source alone
    const auto other = pairOf(randomSimilarity(seed + 10), seed);
    trial.registration.setInputSource(other.source);
    trial.align();
    EXPECT_TRUE(trial.registration.hasConverged());
    expectRight(trial.registration, other);
  }
}

TEST(KSSICP, GivesTheSameBitsWithAnyNumberOfThreads)
{
  const auto pair = pairOf(randomSimilarity(19));
  for (const char* device : {"auto", "host"}) {
    Trial first(pair);
    first.registration.setDevice(device);
    first.registration.setNumberOfThreads(1);
    const Eigen::Matrix4f expected = first.align();
    for (const unsigned int threads : {1u, 2u, 0u}) {
      Trial trial(pair);
      trial.registration.setDevice(device);
      trial.registration.setNumberOfThreads(threads);
      EXPECT_EQ(expected, trial.align()) << device << ", " << threads << " threads";
      EXPECT_EQ(first.registration.getOverlap().score,
                trial.registration.getOverlap().score);
      EXPECT_EQ(first.registration.getAlternatives().size(),
                trial.registration.getAlternatives().size());
    }
  }
}

TEST(KSSICP, RegistersACloudWithItself)
{
  auto pair = pairOf(Eigen::Matrix4d::Identity(), 20);
  pair.source = pair.target;
  Trial trial(pair);
  trial.align();
  EXPECT_TRUE(trial.registration.hasConverged())
      << trial.registration.getFailureReason();
  expectRight(trial.registration, pair, 1e-5);
  EXPECT_NEAR(0.0, trial.registration.getFitnessScore(), 1e-9);
}

TEST(KSSICP, RegistersACloudWithATurnedCopyOfItself)
{
  for (unsigned int seed = 21; seed < 24; ++seed) {
    auto pair = pairOf(randomRigid(seed), seed);
    pair.source = cloudOf<pcl::PointXYZ>(
        transformed(pointsOf(*pair.target), pair.truth.inverse()));
    Trial trial(pair);
    trial.registration.setScaleEstimation(false);
    trial.align();
    EXPECT_TRUE(trial.registration.hasConverged())
        << trial.registration.getFailureReason();
    // Every point meets its own again. Floats of up to ten units round to 1e-6, and so
    // does each of a few dozen steps.
    expectRight(trial.registration, pair, 3e-5);
  }
}

TEST(KSSICP, TakesIdentityForNoGuess)
{
  const auto pair = pairOf(randomSimilarity(22));
  EXPECT_EQ(Trial(pair).align(), Trial(pair).align(Eigen::Matrix4d::Identity()));
}

TEST(KSSICP, IsNotMisledByAGuess)
{
  const auto pair = pairOf(randomSimilarity(23));
  for (const Eigen::Matrix4d& guess :
       {pair.truth, Eigen::Matrix4d(turn(170.0, {1.0, 0.0, 1.0}) * pair.truth),
        randomSimilarity(24)}) {
    Trial trial(pair);
    trial.align(guess);
    EXPECT_TRUE(trial.registration.hasConverged());
    expectRight(trial.registration, pair);
    expectTransformed(trial.output, *pair.source,
                      trial.registration.getFinalTransformation());
  }
}

TEST(KSSICP, MakesUseOfAGuess)
{
  // a search that tries a single rotation, the wrong one, cannot find the pose
  const auto pair = pairOf(turn(137.0, {1.0, 2.0, -1.0}), 25);
  Trial trial(pair);
  set(trial.registration, &pcl::kss::Settings::even_rotations, 1);
  trial.align();
  EXPECT_FALSE(trial.registration.hasConverged());
  EXPECT_NE("", trial.registration.getFailureReason());
  trial.align(turn(5.0, {0.0, 1.0, 0.0}) * pair.truth);
  EXPECT_TRUE(trial.registration.hasConverged());
  expectRight(trial.registration, pair);
}

TEST(KSSICP, IsNeverWorseThanICPFromTheGuess)
{
  // The pennant has two poses of nearly the same score: chance alone ranks them.
  std::mt19937 random(26);
  for (unsigned int seed = 0; seed < 6; ++seed) {
    const Mesh mesh = seed < 3 ? creature() : pennant();
    const auto pair = pairOf(randomRigid(seed), seed, mesh);
    const Eigen::Matrix4d guess = turn(15.0, randomVector(random, 1.0)) * pair.truth;

    ICP icp;
    icp.setMaximumIterations(300);
    icp.setEuclideanFitnessEpsilon(1e-5);
    icp.getConvergeCriteria()->setAbsoluteMSE(0.0);
    setClouds(icp, pair);
    Cloud output;
    icp.align(output, guess.cast<float>());

    Trial trial(pair);
    trial.align(guess);
    const auto local = [](const Cloud& cloud) {
      return pcl::kss::toLocalCloud(
          cloud, pcl::kss::usablePoints(cloud, pcl::kss::allIndices(cloud)));
    };
    pcl::kss::Stages stages;
    const pcl::kss::PoseScorer scorer =
        pcl::kss::Alignment(trial.registration.getSettings())
            .align(local(*pair.source), local(*pair.target), {}, stages)
            .scorer;
    const double ours = scorer.scored(poseFrom(trial.registration)).overlap.score;
    const double theirs = scorer.scored(poseFrom(icp)).overlap.score;
    // the same run of ICP but for the order of rounding
    EXPECT_GT(ours, theirs - 1e-3);
    EXPECT_NEAR(ours, trial.registration.getOverlap().score, 1e-6);
  }
}

TEST(KSSICP, KeepsAKnownScale)
{
  const auto pair = pairOf(randomRigid(27), 27);
  Trial trial(pair);
  trial.registration.setScaleEstimation(false);
  trial.align();
  EXPECT_TRUE(trial.registration.hasConverged());
  expectRight(trial.registration, pair);
  // a product of at most a hundred float rotations
  EXPECT_NEAR(1.0, trial.registration.getScale(), 1e-5);
  for (const auto& alternative : trial.registration.getAlternatives())
    EXPECT_NEAR(1.0, pcl::kss::scaleOf(alternative.transformation), 1e-5);

  // The scale of the guess, whatever the rest of it is worth.
  const auto scaled = pairOf(randomSimilarity(28), 28);
  const double scale = scaleIn(scaled.truth);
  setClouds(trial.registration, scaled);
  Eigen::Matrix4d guess = Eigen::Matrix4d::Identity();
  guess.topLeftCorner<3, 3>() *= scale;
  trial.align(guess);
  EXPECT_TRUE(trial.registration.hasConverged());
  expectRight(trial.registration, scaled);
  EXPECT_NEAR(scale, trial.registration.getScale(), 1e-5 * scale);
  // even where it is wrong
  guess.topLeftCorner<3, 3>() *= 1.05;
  trial.align(guess);
  EXPECT_NEAR(1.05 * scale, trial.registration.getScale(), 1e-5 * scale);
}

TEST(KSSICP, GivesTheFitnessScoreOfItsResult)
{
  const auto pair = pairOf(randomSimilarity(29));
  Trial trial(pair);
  // nothing has been aligned yet
  EXPECT_EQ(std::numeric_limits<double>::max(), trial.registration.getFitnessScore());
  trial.align();
  for (const double max_range : {1e30, 1e-2, 1e-3}) // squared distances
    EXPECT_NEAR(meanSquaredDistance(trial.output, *pair.target, max_range),
                trial.registration.getFitnessScore(max_range), 1e-5);
  EXPECT_GT(trial.registration.getFitnessScore(),
            2.0 * trial.registration.getFitnessScore(1e-3));
  EXPECT_EQ(std::numeric_limits<double>::max(),
            trial.registration.getFitnessScore(0.0));
}

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
