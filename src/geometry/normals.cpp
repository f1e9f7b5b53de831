/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "geometry/normals.h"

#include "geometry/median.h"
#include "support/parallel.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace pcl {
namespace kss {
namespace {

/** Neighbours that a plane is fitted to: an outlier among them does not turn it. */
constexpr Eigen::Index plane_neighbours = 12;

/** Neighbours that tell the noise, and how far off a point's plane the farthest of them
 * is, in standard deviations of normal noise: the median of the third smallest of twelve
 * distances. */
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
    const Eigen::Vector3f point = points.col(i);
    Eigen::Vector3f sum = Eigen::Vector3f::Zero();
    Eigen::Matrix3f scatter = Eigen::Matrix3f::Zero();
    for (Eigen::Index n = 0; n < k; ++n) {
      const Eigen::Vector3f to = points.col(neighbourhoods.indices(n, i)) - point;
      sum += to;
      scatter += to * to.transpose();
    }
    scatter -= sum * sum.transpose() / static_cast<float>(k + 1); // the point included
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3f> solver;
    solver.computeDirect(scatter);
    normals.col(i) = solver.eigenvectors().col(0);
  });
  return normals;
}

float
noiseAbout(const Points& points,
           const Neighbourhoods& neighbourhoods,
           const Points& normals,
           unsigned int threads)
{
  const Eigen::Index k = std::min(plane_neighbours, neighbourhoods.indices.rows());
  if (k < near_neighbours)
    return 0.0f;
  Eigen::VectorXf noise(points.cols());
  inParallel(points.cols(), threads, 500, [&](Eigen::Index i) {
    float off[plane_neighbours];
    for (Eigen::Index n = 0; n < k; ++n)
      off[n] = std::abs(
          normals.col(i).dot(points.col(neighbourhoods.indices(n, i)) - points.col(i)));
    std::nth_element(off, off + near_neighbours - 1, off + k);
    noise[i] = off[near_neighbours - 1];
  });
  return median(noise) / near_neighbour_off;
}

} // namespace kss
} // namespace pcl
