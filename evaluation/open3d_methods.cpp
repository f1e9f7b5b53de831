/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "described_pair.h"
#include "icp.h"

#include <open3d/geometry/KDTreeSearchParam.h>
#include <open3d/geometry/PointCloud.h>
#include <open3d/pipelines/registration/FastGlobalRegistration.h>
#include <open3d/pipelines/registration/Feature.h>
#include <open3d/pipelines/registration/Registration.h>
#include <open3d/utility/Random.h>

#include <omp.h>

#include <memory>

namespace evaluation {
namespace {

namespace registration = open3d::pipelines::registration;
using open3d::geometry::KDTreeSearchParamHybrid;

/** \brief A cloud as Open3D wants it. */
struct Described {
  std::shared_ptr<open3d::geometry::PointCloud> points;
  std::shared_ptr<registration::Feature> features;
};

/** \brief Thinned and described as in Open3D's tutorial on global registration; the
 * normals look at the centroid.
 * \param[in] scale by which the cloud is multiplied first
 */
Described
describe(const Cloud& cloud, double scale, double leaf)
{
  open3d::geometry::PointCloud full;
  full.points_.reserve(cloud.size());
  for (const auto& point : cloud)
    full.points_.push_back(scale * point.getVector3fMap().cast<double>());
  Described result;
  result.points = full.VoxelDownSample(leaf);
  result.points->EstimateNormals(KDTreeSearchParamHybrid(2.0 * leaf, 30));
  result.points->OrientNormalsTowardsCameraLocation(result.points->GetCenter());
  result.features = registration::ComputeFPFHFeature(
      *result.points, KDTreeSearchParamHybrid(5.0 * leaf, 100));
  return result;
}

/** \brief The same numbers in every run: drawn by one thread from one seed. */
void
makeRepeatable(unsigned int seed)
{
  omp_set_num_threads(1);
  open3d::utility::random::Seed(static_cast<int>(seed));
}

Answer
answerFor(const CentredPair& pair,
          const registration::RegistrationResult& coarse,
          float scale,
          const Refinement& refinement)
{
  Eigen::Matrix4f guess = coarse.transformation_.cast<float>();
  guess.topLeftCorner<3, 3>() *= scale;
  Answer answer = refine(pair, guess, refinement);
  answer.claimed = answer.claimed && coarse.fitness_ > 0.0;
  return answer;
}

Answer
registerByRansac(const Task& task)
{
  makeRepeatable(task.seed);
  const CentredPair pair(task);
  // Features of equal surroundings are alike only at about the same scale. Where the
  // source is a part, its extent is not exact; the checker by edges leaves room for it.
  const float scale =
      task.same_scale ? 1.0f : rmsRadiusOf(*pair.target) / rmsRadiusOf(*pair.source);
  const double leaf = leafFor(pair, scale);
  const Described source = describe(*pair.source, scale, leaf);
  const Described target = describe(*pair.target, 1.0, leaf);

  const registration::CorrespondenceCheckerBasedOnEdgeLength edges(
      task.same_scale ? 0.9 : 0.8);
  const registration::CorrespondenceCheckerBasedOnDistance distances(1.5 * leaf);
  const auto coarse = registration::RegistrationRANSACBasedOnFeatureMatching(
      *source.points, *target.points, *source.features, *target.features, false,
      1.5 * leaf, registration::TransformationEstimationPointToPoint(!task.same_scale),
      3, {edges, distances}, registration::RANSACConvergenceCriteria(100000, 0.999));
  return answerFor(pair, coarse, scale, {!task.same_scale});
}

Answer
registerByFgr(const Task& task)
{
  makeRepeatable(task.seed);
  const CentredPair pair(task);
  const double leaf = leafFor(pair);
  const Described source = describe(*pair.source, 1.0, leaf);
  const Described target = describe(*pair.target, 1.0, leaf);

  registration::FastGlobalRegistrationOption options;
  options.use_absolute_scale_ = true;
  options.maximum_correspondence_distance_ = 0.5 * leaf;
  const auto coarse = registration::FastGlobalRegistrationBasedOnFeatureMatching(
      *source.points, *target.points, *source.features, *target.features, options);
  return answerFor(pair, coarse, 1.0f, {});
}

} // namespace

std::vector<Method>
open3dMethods()
{
  return {{"Open3D RANSAC", true, registerByRansac, {}},
          {"Open3D FGR", false, registerByFgr, {}}};
}

} // namespace evaluation
