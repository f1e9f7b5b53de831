/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "case.h"

#include "../benchmarks/diagonal.h"
#include "neighbour_distances.h"
#include "resampling.h"

#include <pcl/common/transforms.h>

#include <algorithm>
#include <cmath>

namespace evaluation {
namespace {

/** (e_noise): p' = p + m n, with m ~ N(0, (r l_k)^2) or, one-sided, m ~ U(0, r l_k).
 * The paper writes U(0, sigma^2), which would be no length.
 */
void
addNoise(const Condition& condition, Random& random, SurfacePoints& points)
{
  if (condition.gaussian == 0.0 && condition.uniform == 0.0)
    return;
  const double l_k = meanNeighbourDistance(points);
  for (auto& point : points) {
    const double m = condition.gaussian * gaussian(random) +
                     condition.uniform * uniform(random, 0.0, 1.0);
    point.position += m * l_k * point.normal;
  }
}

/** \brief Cut off what lies farthest in a random direction. */
void
cutOff(double share, Random& random, SurfacePoints& points)
{
  const Eigen::Vector3d axis = direction(random);
  const auto kept = static_cast<std::ptrdiff_t>(
      std::lround((1.0 - share) * static_cast<double>(points.size())));
  if (share == 0.0)
    return;
  auto along = points;
  std::nth_element(along.begin(), along.begin() + kept - 1, along.end(),
                   [&](const SurfacePoint& a, const SurfacePoint& b) {
                     return a.position.dot(axis) < b.position.dot(axis);
                   });
  const double limit = along[kept - 1].position.dot(axis);
  points.erase(std::remove_if(points.begin(), points.end(),
                              [&](const SurfacePoint& point) {
                                return point.position.dot(axis) > limit;
                              }),
               points.end());
}

Eigen::Matrix4d
randomSimilarity(const Protocol& protocol, Random& random)
{
  const double scale = uniform(random, protocol.smallest_scale, protocol.largest_scale);
  const Eigen::Matrix3d turn = protocol.rotations == Rotations::AXES
                                   ? rotationAboutAxes(random, M_PI / 6.0)
                                   : rotation(random);
  Eigen::Matrix4d similarity = Eigen::Matrix4d::Identity();
  similarity.topLeftCorner<3, 3>() = scale * turn;
  for (int axis = 0; axis < 3; ++axis)
    similarity(axis, 3) = uniform(random, -0.5, 0.5);
  return similarity;
}

Cloud::Ptr
cloudOf(const SurfacePoints& points, const Eigen::Matrix4d& similarity)
{
  const auto cloud = pcl::make_shared<Cloud>();
  cloud->reserve(points.size());
  for (const auto& point : points) {
    const Eigen::Vector3f p =
        (similarity * point.position.homogeneous()).head<3>().cast<float>();
    cloud->push_back({p.x(), p.y(), p.z()});
  }
  return cloud;
}

Normals
normalsOf(const SurfacePoints& points, const Eigen::Matrix4d& similarity)
{
  const Eigen::Matrix3d rotation =
      similarity.topLeftCorner<3, 3>() / scaleOf(similarity);
  Normals normals;
  normals.reserve(points.size());
  for (const auto& point : points)
    normals.push_back((rotation * point.normal).cast<float>());
  return normals;
}

} // namespace

double
scaleOf(const Eigen::Matrix4d& similarity)
{
  return std::cbrt(similarity.topLeftCorner<3, 3>().determinant());
}

Case
makeCase(const Surface& surface,
         const std::string& model,
         const Condition& condition,
         unsigned int repetition,
         const Protocol& protocol)
{
  const std::string names = std::to_string(protocol.seed) + '/' + model + '/' +
                            condition.name + '/' + std::to_string(repetition);
  Random random = randomFor(names);

  const std::size_t half = condition.points / 2;
  auto [target, source] =
      surface.drawTwo(condition.points,
                      condition.resampled ? pointsToResample(half, protocol.resampling)
                                          : condition.points,
                      random);
  if (condition.resampled)
    source = resampled(source, half, protocol.resampling, random);
  addNoise(condition, random, source);
  cutOff(condition.deleted, random, source);

  const Eigen::Matrix4d as_it_is = Eigen::Matrix4d::Identity();
  const Eigen::Matrix4d similarity = randomSimilarity(protocol, random);
  Case result;
  result.target = cloudOf(target, as_it_is);
  result.target_normals = normalsOf(target, as_it_is);
  result.source = cloudOf(source, similarity);
  result.source_normals = normalsOf(source, similarity);
  result.truth = similarity.inverse();
  result.overlap = 1.0 - condition.deleted;
  result.seed = static_cast<unsigned int>(hashOf(names));

  result.diagonal = benchmarks::diagonalOf(*result.target);

  constexpr std::size_t few = 3000, many = 30000;
  const auto [whole, whole_again] = surface.drawTwo(few, many, random);
  result.whole = cloudOf(whole, as_it_is);
  result.whole_again = cloudOf(whole_again, as_it_is);
  return result;
}

Case
withTrueScale(const Case& original)
{
  const double scale = scaleOf(original.truth);
  Case result = original;
  Eigen::Matrix4d scaling = Eigen::Matrix4d::Identity();
  scaling.topLeftCorner<3, 3>() *= scale;
  result.source = pcl::make_shared<Cloud>();
  pcl::transformPointCloud(*original.source, *result.source,
                           scaling.cast<float>().eval());
  result.truth.topLeftCorner<3, 3>() /= scale;
  return result;
}

} // namespace evaluation
