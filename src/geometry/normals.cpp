/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "geometry/normals.h"

#include "support/parallel.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace pcl {
namespace kss {
namespace {

/** Neighbours that a plane is fitted to: an outlier among them does not turn it. */
constexpr Eigen::Index plane_neighbours = 12;

} // namespace

TangentPlanes
tangentPlanes(const Points& points,
              const Neighbourhoods& neighbourhoods,
              unsigned int threads)
{
  const Eigen::Index size = points.cols();
  const Eigen::Index k = std::min(plane_neighbours, neighbourhoods.indices.rows());
  TangentPlanes planes{Points(3, size), Eigen::VectorXf(size)};
  inParallel(size, threads, 500, [&](Eigen::Index i) {
    const Eigen::Vector3f point = points.col(i);
    Eigen::Vector3f sum = Eigen::Vector3f::Zero();
    Eigen::Matrix3f scatter = Eigen::Matrix3f::Zero();
    for (Eigen::Index n = 0; n < k; ++n) {
      const Eigen::Vector3f to = points.col(neighbourhoods.indices(n, i)) - point;
      sum += to;
      scatter += to * to.transpose();
    }
    const auto count = static_cast<float>(k + 1); // the point itself included
    scatter -= sum * sum.transpose() / count;
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3f> solver;
    solver.computeDirect(scatter);
    planes.normals.col(i) = solver.eigenvectors().col(0);
    planes.thickness[i] = std::sqrt(std::max(0.0f, solver.eigenvalues()[0]) / count);
  });
  return planes;
}

} // namespace kss
} // namespace pcl
