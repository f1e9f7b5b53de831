/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "geometry/tangent_planes.h"

#include "geometry/median.h"
#include "support/parallel.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl {
namespace kss {
namespace {

/** Neighbours that a plane is fitted to: an outlier among them does not turn it. */
constexpr Eigen::Index plane_neighbours = 12;

/** Neighbours that tell how far a plane can be trusted, and how far off it the farthest
 * of the nearer ones is, in standard deviations of normal noise: the median of the
 * third smallest of twelve distances. */
constexpr Eigen::Index near_neighbours = 3;
constexpr float near_neighbour_off = 0.391f;

} // namespace

Points
normalsOf(const Points& points,
          const Neighbourhoods& neighbourhoods,
          unsigned int threads)
{
  const Eigen::Index k = std::min(plane_neighbours, neighbourhoods.indices.rows());
  Points normals(3, points.cols());
  inParallel(points.cols(), threads, 500, [&](Eigen::Index i) {
    Eigen::Vector3f sum;
    Eigen::Matrix3f scatter;
    sumUp(points, i, &neighbourhoods.indices(0, i), k, sum, scatter);
    scatter -= sum * sum.transpose() / static_cast<float>(k + 1); // the point included
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3f> solver;
    solver.computeDirect(scatter);
    normals.col(i) = solver.eigenvectors().col(0);
  });
  return normals;
}

void
measureTrust(const Points& points,
             const Neighbourhoods& neighbourhoods,
             unsigned int threads,
             TangentPlanes& planes)
{
  planes.deviations = Eigen::VectorXf::Zero(points.cols());
  planes.agreements = Eigen::VectorXf::Ones(points.cols());
  planes.noise = 0.0f;
  const Eigen::Index k = std::min(plane_neighbours, neighbourhoods.indices.rows());
  if (k < near_neighbours)
    return;
  inParallel(points.cols(), threads, 500, [&](Eigen::Index i) {
    // the three smallest, in order
    float off[near_neighbours], cosine[near_neighbours];
    std::fill_n(off, near_neighbours, std::numeric_limits<float>::infinity());
    const Eigen::Vector3f normal = planes.normals.col(i), point = points.col(i);
    for (Eigen::Index n = 0; n < k; ++n) {
      const int other = neighbourhoods.indices(n, i);
      float larger = std::abs(normal.dot(points.col(other) - point));
      for (float& smaller : off) {
        const float smallest = std::min(smaller, larger);
        larger = std::max(smaller, larger);
        smaller = smallest;
      }
      if (n < near_neighbours)
        cosine[n] = std::abs(normal.dot(planes.normals.col(other)));
    }
    planes.deviations[i] = off[near_neighbours - 1] / near_neighbour_off;
    std::nth_element(cosine, cosine + near_neighbours / 2, cosine + near_neighbours);
    planes.agreements[i] = cosine[near_neighbours / 2];
  });
  planes.noise = median(planes.deviations);
}

} // namespace kss
} // namespace pcl
